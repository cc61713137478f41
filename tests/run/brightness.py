"""FILE.png NAME: the mean of its values and the share of its pixels that are all but black; 1 if it is no lit picture."""
import struct
import sys
import zlib

LEAST, MOST = 0.15, 0.6  # of the mean
BLACK, MOST_BLACK = 0.02, 0.15


def pixels_of(path):
    """Rows of bytes, and how many a pixel has; of PNGs with 8 bits a channel."""
    data, packed, at = open(path, "rb").read(), b"", 8
    while at < len(data):
        (length,) = struct.unpack(">I", data[at:at + 4])
        kind, body = data[at + 4:at + 8], data[at + 8:at + 8 + length]
        if kind == b"IHDR":
            width, height, _, color = struct.unpack(">IIBB", body[:10])
        if kind == b"IDAT":
            packed += body
        at += 12 + length
    step = {0: 1, 2: 3, 6: 4}[color]
    raw, row, rows = zlib.decompress(packed), bytearray(width * step), []
    for y in range(height):
        start = y * (width * step + 1)
        row = unfiltered(raw[start], raw[start + 1:start + 1 + width * step], row, step)
        rows.append(row)
    return rows, step


def unfiltered(how, line, above, step):
    row = bytearray(line)
    for i in range(len(row)):
        left, up = row[i - step] if i >= step else 0, above[i]
        corner = above[i - step] if i >= step else 0
        guess = left + up - corner
        paeth = min((left, up, corner), key=lambda c: abs(guess - c))
        row[i] = row[i] + (0, left, up, (left + up) // 2, paeth)[how] & 255
    return row


def main():
    rows, step = pixels_of(sys.argv[1])
    colors = [row[x:x + 3] for row in rows for x in range(0, len(row), step)]
    mean = sum(map(sum, colors)) / (3 * 255 * len(colors))
    black = sum(max(c) < BLACK * 255 for c in colors) / len(colors)
    lit = LEAST <= mean <= MOST and black < MOST_BLACK
    print(f"{'' if lit else 'FAILED: '}{sys.argv[2]}: mean {mean:.2f}, {100 * black:.1f} % black")
    return 0 if lit else 1


sys.exit(main())
