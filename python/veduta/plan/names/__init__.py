"""What rooms are for: by the words in them, else by their size and neighbours."""
