"""From a record of an animal to its document."""
