"""Photos with silhouettes become a closed, coloured object: `veduta carve`."""

from veduta.carve.command import run_carve
from veduta.carve.options import CarveOptions, ColourOptions, SilhouetteOptions, VolumeOptions

__all__ = ["CarveOptions", "ColourOptions", "SilhouetteOptions", "VolumeOptions", "run_carve"]
