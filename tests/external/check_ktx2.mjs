// node check_ktx2.mjs FILE…: parses KTX2 files with ktx-parse and asserts what pbrbake promises of them.
// ktx-parse is lenient (it takes a faceCount of 5), so ranges are asserted here.

import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import { read } from 'ktx-parse';

/** vkFormat -> what it stores: channels, bytes a component, and of integers whether colours are sRGB. */
const FORMATS = new Map();
for (const [size, kind, ...codes] of [[1, 'unorm', 9, 16, 37], [1, 'srgb', 15, 22, 43], [2, 'unorm', 70, 77, 91],
                                      [2, 'float', 76, 83, 97], [4, 'float', 100, 103, 109]])
    [1, 2, 4].forEach((channels, i) => FORMATS.set(codes[i], {channels, size, kind}));
const ALPHA = 15, LINEAR = 0x10, FLOAT_SIGNED = 0xc0;

function checkDescriptor(descriptor, {channels, size, kind}) {
    assert.equal(descriptor.vendorId, 0);
    assert.equal(descriptor.descriptorType, 0);
    assert.equal(descriptor.versionNumber, 2, 'KDF 1.3');
    assert.equal(descriptor.colorModel, 1, 'RGBSDA');
    assert.equal(descriptor.transferFunction, kind === 'srgb' ? 2 : 1, 'linear or sRGB');
    assert.ok([0, 1, 7].includes(descriptor.colorPrimaries), 'primaries: unspecified, BT.709 or AP1');
    assert.equal(descriptor.flags, 0);
    assert.deepEqual([...descriptor.texelBlockDimension], [0, 0, 0, 0]);
    assert.deepEqual([...descriptor.bytesPlane], [channels * size, 0, 0, 0, 0, 0, 0, 0]);
    assert.equal(descriptor.samples.length, channels);
    const [lower, upper] = kind === 'float' ? [0xbf800000, 0x3f800000] : [0, 2 ** (8 * size) - 1];
    descriptor.samples.forEach((sample, i) => {
        assert.equal(sample.bitOffset, i * size * 8);
        assert.equal(sample.bitLength, size * 8 - 1);
        const qualifiers = kind === 'float' ? FLOAT_SIGNED : kind === 'srgb' && i === 3 ? LINEAR : 0;
        assert.equal(sample.channelType, (i === 3 ? ALPHA : i) | qualifiers);
        assert.deepEqual([...sample.samplePosition], [0, 0, 0, 0]);
        assert.equal(sample.sampleLower >>> 0, lower, 'black');
        assert.equal(sample.sampleUpper >>> 0, upper, 'white');
    });
}

function checkFile(bytes) {
    const file = read(bytes);
    const format = FORMATS.get(file.vkFormat);
    assert.ok(format, `vkFormat ${file.vkFormat}`);
    assert.equal(file.typeSize, format.size);
    assert.ok(file.faceCount === 1 || file.faceCount === 6, `faceCount ${file.faceCount}`);
    if (file.faceCount === 6) assert.equal(file.pixelWidth, file.pixelHeight);
    if (file.faceCount === 6) assert.equal(file.pixelDepth, 0);
    assert.equal(file.layerCount, 0);
    assert.equal(file.supercompressionScheme, 0);
    const levelCount = new DataView(bytes.buffer, bytes.byteOffset).getUint32(40, true);
    assert.equal(file.levels.length, levelCount);
    const sides = [file.pixelWidth, file.pixelHeight, Math.max(1, file.pixelDepth)];
    assert.ok(levelCount >= 1 && levelCount <= 1 + Math.floor(Math.log2(Math.max(...sides))));
    file.levels.forEach((level, i) => {
        const texels = sides.reduce((product, side) => product * Math.max(1, side >> i), file.faceCount);
        assert.equal(level.levelData.byteLength, texels * format.channels * format.size, `level ${i}`);
        assert.equal(level.uncompressedByteLength, level.levelData.byteLength);
    });
    assert.equal(file.dataFormatDescriptor.length, 1);
    checkDescriptor(file.dataFormatDescriptor[0], format);
    assert.equal(file.keyValue.KTXorientation, file.pixelDepth > 0 ? 'rdi' : 'rd');
    assert.match(file.keyValue.KTXwriter, /^pbrbake \d+\.\d+\.\d+$/);
}

const paths = process.argv.slice(2);
let failures = 0;
for (const path of paths) {
    try {
        checkFile(new Uint8Array(readFileSync(path)));
    } catch (error) {
        ++failures;
        console.error(`${path}: ${error.message}`);
    }
}
if (paths.length === 0) console.error('usage: node check_ktx2.mjs FILE…');
console.log(`${paths.length} files, ${failures} failures`);
process.exitCode = failures > 0 || paths.length === 0 ? 1 : 0;
