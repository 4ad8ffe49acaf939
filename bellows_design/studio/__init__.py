"""A page on this machine to change a design in and see at once what becomes of it.

``serving`` answers the browser, ``session`` decides what is computed next, ``workers`` runs that in
processes of its own (``tasks``), ``display`` makes the shapes that are shown before there is CAD.
What page and server say to each other is written down in docs/studio-protocol.md.
"""
