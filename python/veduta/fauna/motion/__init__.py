"""Motion without limbs: the axis' angles, its states, the motion graph and walks in it."""
