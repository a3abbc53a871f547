"""From a log to the document and the record."""
