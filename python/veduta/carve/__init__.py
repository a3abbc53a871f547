"""Photos with silhouettes become a closed, coloured object: `veduta carve`."""
