"""From the document and the record to a place."""
