"""Panes: what one sees in them, for surfaces reflect nothing by themselves."""

from __future__ import annotations

import numpy as np

from veduta.grammar.surfaces.canvas import Canvas, Image, eased, mixed

SKY, HOUSES, ROOM = (0.84, 0.93, 1.0), (0.66, 0.66, 0.64), (0.5, 0.52, 0.52)
"""What shines in a pane from the top to the bottom: the sky, houses opposite, the room behind."""
ENDS, HEIGHTS = (0.24, 0.42, 0.68, 0.86), (0.42, 0.52, 0.37, 0.47)
"""Where roofs opposite end, and how high they are, as shares of the pane's sides."""


def window(canvas: Canvas) -> Image:
    """A pane with the sky and the houses opposite in it."""
    height, width = canvas.size_m[1], canvas.size_m[0]
    up = canvas.y_m[:, None] / height
    # Roofs of several heights; the last goes on as the first.
    along = canvas.x_m[None, :] / width
    roofs = np.select([along < end for end in ENDS], HEIGHTS, HEIGHTS[0])
    in_sky = canvas.blurred(eased(up - roofs, -0.004, 0.004), 0.02)
    below = 1.0 - eased(up, 0.02, 0.34)
    above = 1.0 - eased(1.0 - up, 0.0, 0.1)  # towards the border, where the bottom comes again
    room = np.maximum(below, above)
    colour = mixed(mixed(HOUSES, SKY, in_sky), ROOM, room)
    sky = in_sky * (1.0 - room)
    clouds = 0.02 * canvas.noise(0.8, 0.2, stretch=(2.0, 1.0))
    shade = np.asarray(0.66 + sky * (0.3 + clouds) - 0.12 * room, np.float32)
    return canvas.image(shade, colour, 0.6)
