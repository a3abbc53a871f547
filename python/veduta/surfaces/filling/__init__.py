"""Holes in textures of facades, filled with what stands elsewhere on them."""
