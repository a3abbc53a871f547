"""What a call gives: photos, masks, a film, a model of other software."""
