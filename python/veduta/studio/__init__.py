"""The web studio: serving a place on this machine, and exporting it as a static folder."""
