"""What is written on a sheet: where text stands, what it says, and which way up the sheet is."""
