"""The house as CityJSON: its outer shell, the air of its rooms, and what stands in them."""
