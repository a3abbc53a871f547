"""Plans that are vectors already: DXF files, whose lines are exact and whose layers have names."""
