"""Charts as SVG in a page: curves with error bands, signed bars, clouds of points.

Their colours are those of `style.page_style`, so they follow light and dark. Numbers that are not
finite are left out; all text is escaped. A chart is 480 pixels wide unless its page makes it less.
"""

from bellows_design.web.charts.bars import bar_chart
from bellows_design.web.charts.curves import line_chart, scatter_chart
from bellows_design.web.charts.parts import Bar, Limit, Line, Mark
from bellows_design.web.charts.scales import ChartError

__all__ = [
    "Bar",
    "ChartError",
    "Limit",
    "Line",
    "Mark",
    "bar_chart",
    "line_chart",
    "scatter_chart",
]
