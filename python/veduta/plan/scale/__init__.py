"""How large a pixel is: the sizes written on a sheet against what is drawn, and their vote."""
