"""The verb `veduta plan`: a scanned floor plan becomes a house that one can walk through."""
