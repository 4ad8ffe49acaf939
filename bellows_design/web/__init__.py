"""Pages: surfaces that turn in a browser, their packing, page style, charts, layers of a print.

It knows arrays and text only. `scene` holds the surfaces, `element` puts them on a page, `style` is
the page's look, `charts` draws curves and bars, `layers` shows what a slicer laid down. The viewer
itself is JavaScript: its sources are in `javascript`, its bundle in `assets`.
"""
