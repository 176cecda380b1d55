#!/usr/bin/env python3
"""Writes sky.exr: 64 x 32 texels of latitude and longitude, a gradient with a sun of radius 8 degrees above a brown horizon."""
import math

import numpy as np
import OpenImageIO as oiio

WIDTH, HEIGHT = 64, 32
SUN_AZIMUTH, SUN_ELEVATION, SUN_RADIUS = math.radians(-130), math.radians(35), math.radians(8)
ZENITH, HORIZON, GROUND, SUN = (0.15, 0.3, 0.8), (0.8, 0.85, 0.9), (0.12, 0.1, 0.08), (60, 52, 40)
SUB = 16  # points a side of each texel, which is their mean

azimuth = ((np.arange(WIDTH * SUB) + 0.5) / (WIDTH * SUB) * 2 - 1) * math.pi
elevation = (0.5 - (np.arange(HEIGHT * SUB) + 0.5) / (HEIGHT * SUB)) * math.pi
azimuth, elevation = np.meshgrid(azimuth, elevation)
up = np.clip(np.sin(elevation), 0, 1)[..., None] ** 0.5
sky = np.where(elevation[..., None] > 0, up * ZENITH + (1 - up) * HORIZON, GROUND)
cosine = np.sin(elevation) * math.sin(SUN_ELEVATION) + np.cos(elevation) * math.cos(SUN_ELEVATION) * np.cos(azimuth - SUN_AZIMUTH)
sky = np.where(cosine[..., None] > math.cos(SUN_RADIUS), SUN, sky)
texels = sky.reshape(HEIGHT, SUB, WIDTH, SUB, 3).mean(axis=(1, 3)).astype(np.float32)

spec = oiio.ImageSpec(WIDTH, HEIGHT, 3, oiio.HALF)
spec.attribute("compression", "zip")
out = oiio.ImageOutput.create("sky.exr")
out.open("sky.exr", spec)
out.write_image(texels)
out.close()
