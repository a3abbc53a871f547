"""From a plan document to a house: footprints, solids, surfaces with classes and materials."""
