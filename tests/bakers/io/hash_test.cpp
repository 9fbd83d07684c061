// XXH3-128 in its canonical order.

#include <gtest/gtest.h>

#include "tests/bakers/io/fixtures.hpp"

namespace pbrbake::io::test {
namespace {

TEST(Hash, OfNothingIsTheKnownOne) {
    EXPECT_EQ(hash_bytes(nullptr, 0), "99aa06d3014798d86001c324468d497f");  // xxhsum -H2 of an empty file
}

TEST(Hash, FilesAndBuffersAgree) {
    TempDir dir;
    Buffer bytes;
    for (unsigned i = 0; i < 3000000; ++i) bytes.push_back(static_cast<std::byte>(i * i >> 3));
    write_file(dir / "a", bytes);
    EXPECT_EQ(hash_file(dir / "a"), hash_bytes(bytes.data(), bytes.size()));
    bytes[1234567] ^= std::byte{1};
    EXPECT_NE(hash_file(dir / "a"), hash_bytes(bytes.data(), bytes.size()));
}

TEST(Hash, OfAnAbsentFileIsAnError) {
    try {
        hash_file("/nowhere/at/all");
        FAIL();
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ExitCode::unreadable_input);
        EXPECT_EQ(error.where(), "/nowhere/at/all");
    }
}

}  // namespace
}  // namespace pbrbake::io::test
