"""Input files of Abaqus and CalculiX: meshes read and written, problems written as decks."""
