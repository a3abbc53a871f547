"""One photo of a facade becomes a shape-grammar derivation and a LoD3 building."""
