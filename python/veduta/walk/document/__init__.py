"""`walk.json`: the key positions, the transitions between them, and how good each is."""
