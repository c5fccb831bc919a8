"""OpenEXR scan lines of 32-bit floats, by the published file layout: what the data scripts beside the cases need."""
import struct
import zlib


def _attribute(name, kind, data):
    return name.encode() + b"\0" + kind.encode() + b"\0" + struct.pack("<i", len(data)) + data


def _compress(data):
    """A scan line as ZIPS has it: even bytes before odd ones, differences, deflate; as it is where that is no shorter."""
    ordered = data[0::2] + data[1::2]
    changes = bytes([ordered[0]] + [(b - a + 128) & 255 for a, b in zip(ordered, ordered[1:])])
    packed = zlib.compress(changes, 9)
    return packed if len(packed) < len(data) else data


def write(path, width, height, planes, compress=False):
    """planes: channel name -> function of (column, row); the names in the order that the format asks for, which is theirs as bytes."""
    names = sorted(planes, key=str.encode)
    channels = b"".join(name.encode() + b"\0" + struct.pack("<iBBBBii", 2, 0, 0, 0, 0, 1, 1) for name in names) + b"\0"
    window = struct.pack("<iiii", 0, 0, width - 1, height - 1)
    header = struct.pack("<ii", 20000630, 2)
    header += _attribute("channels", "chlist", channels)
    header += _attribute("compression", "compression", b"\2" if compress else b"\0")
    header += _attribute("dataWindow", "box2i", window) + _attribute("displayWindow", "box2i", window)
    header += _attribute("lineOrder", "lineOrder", b"\0")
    header += _attribute("pixelAspectRatio", "float", struct.pack("<f", 1))
    header += _attribute("screenWindowCenter", "v2f", struct.pack("<ff", 0, 0))
    header += _attribute("screenWindowWidth", "float", struct.pack("<f", 1)) + b"\0"
    lines = []
    for row in range(height):
        data = b"".join(struct.pack("<f", planes[name](column, row)) for name in names for column in range(width))
        data = _compress(data) if compress else data
        lines.append(struct.pack("<ii", row, len(data)) + data)
    offset = len(header) + 8 * height
    with open(path, "wb") as file:
        file.write(header)
        for line in lines:
            file.write(struct.pack("<Q", offset))
            offset += len(line)
        file.write(b"".join(lines))
