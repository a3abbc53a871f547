"""The guided tour of a house: a way through all rooms, and where to look on it."""
