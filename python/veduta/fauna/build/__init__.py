"""From the document of an animal to its mesh, its clips and its place."""
