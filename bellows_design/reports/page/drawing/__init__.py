"""Plane drawings as plain values, and as SVG."""
