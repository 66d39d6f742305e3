# SPDX-License-Identifier: MIT
"""PhysVib: collisions one can feel. Events and samples are numpy arrays; units are SI, and stand in the names.

>>> import physvib
>>> hit = physvib.events([0.1], frequency_hz=200.0, decay_per_s=30.0, amplitude=0.5)
>>> samples = physvib.render(hit, seconds=1.0, layout="phone4")  # float32, shape (4, 48000)
>>> physvib.save_wav("hit.wav", samples)
"""
from ._header import AUTOMATIC, EVENT, HIT, ROLL, SLIDE
from ._library import PhysVibError, version
from .files import EventList, events, events_of, frame, load_events, parse_events, render, save_events, save_wav
from .layout import Layout
from .live import Device, Live, LiveStatus, Receipt, devices, follow_each
from .material_table import Material, impact, material, materials, part, sound
from .pads import Pads
from .renderer import Renderer, Status, play_out_s
from .session import Session
from .space import SpaceHaptics, attach
from .world import POINT_BY_PLACE, SOFT_WHOLE, Counts, World

__version__ = version()
__all__ = ["AUTOMATIC", "Counts", "Device", "EVENT", "EventList", "HIT", "Layout", "Live", "LiveStatus", "Material", "Pads", "POINT_BY_PLACE", "PhysVibError", "ROLL", "Receipt", "Renderer", "SLIDE", "SOFT_WHOLE", "Session", "SpaceHaptics", "Status", "World", "attach", "devices", "events", "events_of", "follow_each", "frame", "impact", "load_events", "material", "materials", "parse_events", "part", "play_out_s", "render", "save_events", "save_wav", "sound"]
