"""Flights of stairs, where they are drawn."""
