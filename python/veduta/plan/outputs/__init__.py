"""The files of a plan: drawings (SVG, DXF, overlay), the building model (IFC)."""
