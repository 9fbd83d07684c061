// node check_ktx2.mjs FILE…: parses KTX2 files with ktx-parse and asserts what pbrbake promises of them.
// ktx-parse is lenient (it takes a faceCount of 5), so ranges are asserted here.

import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import { read } from 'ktx-parse';

/** vkFormat -> [channels, bytes a component] of R, RG and RGBA in half and float. */
const FORMATS = new Map([[76, [1, 2]], [83, [2, 2]], [97, [4, 2]], [100, [1, 4]], [103, [2, 4]], [109, [4, 4]]]);
const ALPHA = 15, FLOAT_SIGNED = 0xc0;

function checkDescriptor(descriptor, channels, bytes) {
    assert.equal(descriptor.vendorId, 0);
    assert.equal(descriptor.descriptorType, 0);
    assert.equal(descriptor.versionNumber, 2, 'KDF 1.3');
    assert.equal(descriptor.colorModel, 1, 'RGBSDA');
    assert.equal(descriptor.transferFunction, 1, 'linear');
    assert.ok([0, 1, 7].includes(descriptor.colorPrimaries), 'primaries: unspecified, BT.709 or AP1');
    assert.equal(descriptor.flags, 0);
    assert.deepEqual([...descriptor.texelBlockDimension], [0, 0, 0, 0]);
    assert.deepEqual([...descriptor.bytesPlane], [channels * bytes, 0, 0, 0, 0, 0, 0, 0]);
    assert.equal(descriptor.samples.length, channels);
    descriptor.samples.forEach((sample, i) => {
        assert.equal(sample.bitOffset, i * bytes * 8);
        assert.equal(sample.bitLength, bytes * 8 - 1);
        assert.equal(sample.channelType, (i === 3 ? ALPHA : i) | FLOAT_SIGNED);
        assert.deepEqual([...sample.samplePosition], [0, 0, 0, 0]);
        assert.equal(sample.sampleLower >>> 0, 0xbf800000, '-1.0f');
        assert.equal(sample.sampleUpper >>> 0, 0x3f800000, '1.0f');
    });
}

function checkFile(bytes) {
    const file = read(bytes);
    assert.ok(FORMATS.has(file.vkFormat), `vkFormat ${file.vkFormat}`);
    const [channels, size] = FORMATS.get(file.vkFormat);
    assert.equal(file.typeSize, size);
    assert.ok(file.faceCount === 1 || file.faceCount === 6, `faceCount ${file.faceCount}`);
    if (file.faceCount === 6) assert.equal(file.pixelWidth, file.pixelHeight);
    assert.equal(file.pixelDepth, 0);
    assert.equal(file.layerCount, 0);
    assert.equal(file.supercompressionScheme, 0);
    const levelCount = new DataView(bytes.buffer, bytes.byteOffset).getUint32(40, true);
    assert.equal(file.levels.length, levelCount);
    assert.ok(levelCount >= 1 && levelCount <= 1 + Math.floor(Math.log2(Math.max(file.pixelWidth, file.pixelHeight))));
    file.levels.forEach((level, i) => {
        const width = Math.max(1, file.pixelWidth >> i), height = Math.max(1, file.pixelHeight >> i);
        assert.equal(level.levelData.byteLength, width * height * file.faceCount * channels * size, `level ${i}`);
        assert.equal(level.uncompressedByteLength, level.levelData.byteLength);
    });
    assert.equal(file.dataFormatDescriptor.length, 1);
    checkDescriptor(file.dataFormatDescriptor[0], channels, size);
    assert.equal(file.keyValue.KTXorientation, 'rd');
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
