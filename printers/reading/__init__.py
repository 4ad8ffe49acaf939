"""Parts as other programs write them: STL, 3MF and STEP, read as one triangle mesh in mm.

Files come from anywhere. Each is refused in one sentence, with bounded time and memory, unless it
holds what its format promises. Units are those of the file; they are said, and never guessed.
"""
