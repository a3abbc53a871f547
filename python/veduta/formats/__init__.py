"""Open formats, one file each; another format's axes and encodings stay inside its file."""
