"""A planar chain of half bubbles between two stubs, and its equilibrium among loads and objects.

``finger`` says what the chain is, ``surroundings`` and ``contact`` what acts on it. ``path``
follows its equilibria from rest, ``grip`` pulls an object out of it; ``state`` is what they return.
"""
