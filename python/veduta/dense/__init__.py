"""Calibrated photos become depth maps, a cloud and a mesh: `veduta dense`."""
