"""The verb `veduta photos`: a folder of ordinary photos becomes calibrated cameras and points."""
