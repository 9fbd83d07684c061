#!/usr/bin/env python3
"""What a probe costs by the sizes of its output and of its source.

    tests/bench/probe_sizes.py build/release/bin/pbrbake [LARGEST] [FOLDER]  > tables.md

Prints two tables. The first: CPU seconds of the bake, the least of four, by size of the output and accuracy, levels down
to 8 texels a side. The second: CPU seconds of decoding, baking and certifying and the peak memory, the least of two, of
sources 512 to LARGEST texels around (16384 if not given), those of 16384 once. Sources are generated: noise over a soft
sky with a sun, uncompressed float EXR, the largest as HDR too. They are written to FOLDER, a temporary one if not
given, and take 12 bytes a texel. One thread throughout; under four minutes on an idle machine.
"""
import array
import json
import os
import random
import struct
import sys
import tempfile

SIZES = (64, 128, 256, 512, 1024)
ACCURACIES = ("draft", "production", "reference")
RUNS = 4
DISTINCT = 64  # rows of noise


def sky_row(width, height, y, noise):
    """RGB planes of a row."""
    up = 1 - 2 * (y + 0.5) / height
    planes = [array.array("f", (v * scale for v in noise)) for scale in (0.6 + 0.2 * up, 0.7 + 0.3 * up, 0.9 + 0.5 * up)]
    if y == height // 3:
        for plane in planes:
            plane[width // 5] = 2e4
    return planes


def rows_of(width):
    generator = random.Random(7)
    height = width // 2
    noises = [[0.7 + 0.6 * generator.random() for _ in range(width)] for _ in range(DISTINCT)]
    band = max(1, height // DISTINCT)
    kept = None, None
    for y in range(height):
        key = y if y == height // 3 else -(y // band) - 1
        if kept[0] != key:
            kept = key, sky_row(width, height, y, noises[y // band % DISTINCT])
        yield kept[1]


def write_exr(path, width):
    height = width // 2
    channels = b"".join(name + b"\0" + struct.pack("<iBBBBii", 2, 0, 0, 0, 0, 1, 1) for name in (b"B", b"G", b"R")) + b"\0"
    box = struct.pack("<4i", 0, 0, width - 1, height - 1)
    header = b"\x76\x2f\x31\x01" + struct.pack("<i", 2)
    for name, kind, value in (("channels", "chlist", channels), ("compression", "compression", b"\0"),
                              ("dataWindow", "box2i", box), ("displayWindow", "box2i", box), ("lineOrder", "lineOrder", b"\0"),
                              ("pixelAspectRatio", "float", struct.pack("<f", 1)),
                              ("screenWindowCenter", "v2f", struct.pack("<2f", 0, 0)),
                              ("screenWindowWidth", "float", struct.pack("<f", 1))):
        header += name.encode() + b"\0" + kind.encode() + b"\0" + struct.pack("<i", len(value)) + value
    header += b"\0"
    line = 8 + 12 * width
    first = len(header) + 8 * height
    with open(path, "wb") as file:
        file.write(header + struct.pack(f"<{height}Q", *(first + y * line for y in range(height))))
        for y, (r, g, b) in enumerate(rows_of(width)):
            file.write(struct.pack("<2i", y, 12 * width) + b.tobytes() + g.tobytes() + r.tobytes())


def write_hdr(path, width):
    """Mantissas from the noise, one exponent; run-length rows without runs."""
    height = width // 2
    with open(path, "wb") as file:
        file.write(b"#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y %d +X %d\n" % (height, width))
        kept = None, None
        for planes in rows_of(width):
            if kept[0] is not planes:
                row = b"\x02\x02" + struct.pack(">H", width)
                for values in [bytes(min(255, int(100 * v)) for v in plane) for plane in planes] + [b"\x81" * width]:
                    row += b"".join(b"\x80" + values[i:i + 128] for i in range(0, width, 128))
                kept = planes, row
            file.write(kept[1])


def run(program, folder, source, options):
    """CPU seconds by stage, and the peak memory in bytes."""
    report, out = os.path.join(folder, "report.json"), os.path.join(folder, "probe.ktx2")
    command = [program, "probe", source, "--threads", "1", "--report", report, "-o", out, *options]
    child = os.posix_spawn(program, command, os.environ,
                           file_actions=[(os.POSIX_SPAWN_OPEN, 1, os.devnull, os.O_WRONLY, 0),
                                         (os.POSIX_SPAWN_OPEN, 2, os.path.join(folder, "errors"), os.O_CREAT | os.O_TRUNC | os.O_WRONLY, 0o600)])
    _, status, usage = os.wait4(child, 0)
    if os.waitstatus_to_exitcode(status) not in (0, 7):  # 7: less accurate than asked
        with open(os.path.join(folder, "errors")) as errors:
            sys.exit(f"{' '.join(command)}\n{errors.read()}")
    with open(report) as file:
        stages = json.load(file)["bakes"][0]["stages"]
    os.remove(out)
    return {name: stage["cpu_s"] for name, stage in stages.items()}, usage.ru_maxrss * 1024


def by_output(program, folder, sources):
    print("| source | accuracy | " + " | ".join(f"{size}²" for size in SIZES) + " |\n" + "|---" * (len(SIZES) + 2) + "|")
    for width in sources:
        for accuracy in ACCURACIES:
            cells = []
            for size in SIZES:
                options = ["--size", str(size), "--levels", str(size.bit_length() - 3), "--accuracy", accuracy, "--certify", "none"]
                cells.append(min(run(program, folder, sources[width], options)[0]["bake"] for _ in range(RUNS)))
            print(f"| {width} x {width // 2} | `{accuracy}` | " + " | ".join(f"{s:.3f}" for s in cells) + " |", flush=True)


def by_source(program, folder, width, path):
    runs = [run(program, folder, path, ["--size", "256", "--levels", "6"]) for _ in range(1 if width > 8192 else 2)]
    stages = {name: min(stages[name] for stages, _ in runs) for name in ("decode", "bake", "certify")}
    kind = os.path.splitext(path)[1][1:].upper()
    print(f"| {width} x {width // 2}, {kind} | " + " | ".join(f"{s:.3f}" for s in stages.values()) +
          f" | {stages['certify'] / stages['bake']:.2f} | {max(peak for _, peak in runs) / 2**20:.0f} MB |", flush=True)


def main():
    program, largest = sys.argv[1], int(sys.argv[2]) if len(sys.argv) > 2 else 16384
    with tempfile.TemporaryDirectory(dir=sys.argv[3] if len(sys.argv) > 3 else None) as folder:
        small = {}
        for width in (2048, 512):
            small[width] = os.path.join(folder, f"sky_{width}.exr")
            write_exr(small[width], width)
        by_output(program, folder, small)
        print("\n| source | decode | bake | certify, sampled | certify / bake | peak memory |\n|---|---|---|---|---|---|")
        width = 512
        while width <= largest:
            for kind, write in (("exr", write_exr), ("hdr", write_hdr)):
                if kind == "hdr" and width < largest:
                    continue
                path = os.path.join(folder, f"source.{kind}")
                write(path, width)
                by_source(program, folder, width, path)
                os.remove(path)
            width *= 2


if __name__ == "__main__":
    main()
