"""Prints the pictures of a folder as JSON, read by OpenImageIO: {file: {channel: [values]}}. They are *.exr unless a second argument says."""
import json
import pathlib
import sys

import OpenImageIO as oiio


def read(path):
    file = oiio.ImageInput.open(str(path))
    spec = file.spec()
    values = file.read_image("float")
    file.close()
    return {name: [v if v < float("inf") else None for v in values[:, :, c].ravel().tolist()] for c, name in enumerate(spec.channelnames)}


print(json.dumps({path.name: read(path) for path in sorted(pathlib.Path(sys.argv[1]).glob((sys.argv[2:] or ["*.exr"])[0]))}))
