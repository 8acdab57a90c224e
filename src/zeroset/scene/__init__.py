"""What is drawn and how it is seen: surfaces, bounds, cameras, lights, materials, scenes and their files."""
