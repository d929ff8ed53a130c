#include "engine/platform/files.h"

#include <gtest/gtest.h>

namespace vellus {
namespace {

std::filesystem::path fresh_folder(const char* name) {
    auto folder = std::filesystem::temp_directory_path() / name;
    std::filesystem::remove_all(folder);
    return folder;
}

TEST(Files, WhatWasWrittenIsReadBack) {
    const auto path = fresh_folder("vellus_files_1") / "a" / "b.bin";
    ASSERT_TRUE(write_file(path, std::string_view("one\0two", 7)));
    const auto bytes = read_file(path);
    ASSERT_TRUE(bytes);
    EXPECT_EQ(bytes->size(), 7u);
    EXPECT_EQ(static_cast<char>((*bytes)[4]), 't');
    ASSERT_TRUE(write_file(path, std::string_view("3")));
    EXPECT_EQ(read_file(path)->size(), 1u);
}

TEST(Files, FailedWriteNamesTheFileAndLeavesNothing) {
    const auto folder = fresh_folder("vellus_files_2");
    std::filesystem::create_directories(folder / "taken");
    const auto result = write_file(folder / "taken", std::string_view("text"));
    ASSERT_FALSE(result);
    EXPECT_NE(result.error().message().find("taken"), std::string::npos);
    size_t entries = 0;
    for (const auto& entry : std::filesystem::directory_iterator(folder)) {
        EXPECT_EQ(entry.path().filename(), "taken");
        ++entries;
    }
    EXPECT_EQ(entries, 1u);
}

TEST(Files, MissingFileAndFolderAreErrorsThatNameThem) {
    const auto folder = fresh_folder("vellus_files_3");
    std::filesystem::create_directories(folder);
    EXPECT_NE(read_file(folder / "none.bin").error().message().find("none.bin"), std::string::npos);
    EXPECT_NE(read_file(folder).error().message().find("not a regular file"), std::string::npos);
}

}  // namespace
}  // namespace vellus
