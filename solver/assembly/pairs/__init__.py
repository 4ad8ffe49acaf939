"""Contacts of a problem on its mesh: gaps, energy, forces and their derivatives, by what is met."""
