"""`animal.json`: what was found of an animal, from which all else is built."""
