"""What an actuator exerts: a chain of half bubbles that obey the unit cell's law, under loads.

``law`` tabulates how a half bubble answers to pressure and section loads, ``chain`` puts half
bubbles together and finds their equilibrium, ``scenes`` says what stands around them.
"""
