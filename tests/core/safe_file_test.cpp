// Files under bad luck: two writers, full disks, kills, pipes that nobody reads.
#include "engine/core/safe_file.h"

#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <filesystem>
#include <thread>

#include "tests/support/own_folder.h"

namespace ag {
namespace {

namespace fs = std::filesystem;

size_t filesIn(const fs::path& path) {
    return size_t(std::distance(fs::directory_iterator(path), fs::directory_iterator()));
}

// One letter, many times over: a mixture is a torn file.
std::string letters(char letter, size_t count) {
    return std::string(count, letter);
}

bool isWhole(const std::string& text, size_t count) {
    return text.size() == count && text.find_first_not_of(text[0]) == std::string::npos;
}

// Runs `body` in a process of its own; its exit code.
template <class F>
pid_t inChild(F&& body) {
    const pid_t child = fork();
    if (child == 0) _exit(body());
    return child;
}

int exitCodeOf(pid_t child) {
    int status = 0;
    waitpid(child, &status, 0);
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

TEST(SafeFile, ReplacesAndKeepsPermissionsAndLinks) {
    const fs::path at = test::ownFolder();
    const std::string path = at / "a.txt", link = at / "link.txt";
    ASSERT_TRUE(writeFileSafely(path, "one"));
    ASSERT_EQ(chmod(path.c_str(), 0640), 0);
    fs::create_symlink(path, link);
    ASSERT_TRUE(writeFileSafely(link, "two"));
    EXPECT_TRUE(fs::is_symlink(link));
    EXPECT_EQ(*readFile(path), "two");
    EXPECT_EQ(fs::status(path).permissions(), fs::perms(0640));
    EXPECT_EQ(filesIn(at), 2u) << "no temporary file stays";
}

TEST(SafeFile, WritersBesideEachOtherNeverTearAFile) {
    constexpr size_t kBytes = 200'000;
    constexpr int kRounds = 300;
    const fs::path at = test::ownFolder();
    const std::string path = at / "shared.txt";
    ASSERT_TRUE(writeFileSafely(path, letters('a', kBytes)));
    pid_t writers[2];
    for (int w = 0; w < 2; ++w)
        writers[w] = inChild([&] {
            for (int i = 0; i < kRounds; ++i)
                if (!writeFileSafely(path, letters(char('a' + (2 * i + w) % 26), kBytes))) return 1;
            return 0;
        });
    int torn = 0, reads = 0;
    for (bool writing = true; writing; ++reads) {
        const auto text = readFile(path);
        torn += !text || !isWhole(*text, kBytes);
        writing = waitpid(writers[0], nullptr, WNOHANG) == 0;
    }
    EXPECT_EQ(torn, 0) << "of " << reads;
    EXPECT_EQ(exitCodeOf(writers[1]), 0) << "a write failed because of the other";
    EXPECT_EQ(filesIn(at), 1u);
}

TEST(SafeFile, AKillAtAnyMomentLeavesAWholeFile) {
    constexpr size_t kBytes = 400'000;
    const fs::path at = test::ownFolder();
    const std::string path = at / "save.txt";
    ASSERT_TRUE(writeFileSafely(path, letters('o', kBytes)));
    for (int i = 0; i < 60; ++i) {
        const pid_t writer = inChild([&] {
            for (char letter = 'a';; letter = letter == 'z' ? 'a' : char(letter + 1))
                if (!writeFileSafely(path, letters(letter, kBytes))) return 1;
        });
        std::this_thread::sleep_for(std::chrono::microseconds(1000 + 137 * i));
        kill(writer, SIGKILL);
        waitpid(writer, nullptr, 0);
        const auto text = readFile(path);
        ASSERT_TRUE(text) << text.error().message;
        ASSERT_TRUE(isWhole(*text, kBytes)) << "after kill " << i;
    }
}

TEST(SafeFile, AFullDiskLeavesTheOldFile) {
    const fs::path at = test::ownFolder();
    const std::string path = at / "a.bin";
    ASSERT_TRUE(writeFileSafely(path, "old"));
    const pid_t child = inChild([&] {
        signal(SIGXFSZ, SIG_IGN);
        const rlimit limit{4096, 4096};
        setrlimit(RLIMIT_FSIZE, &limit);
        const Status written = writeFileSafely(path, letters('n', 100'000));
        return !written && written.error().message.starts_with("cannot write " + path) ? 0 : 1;
    });
    EXPECT_EQ(exitCodeOf(child), 0);
    EXPECT_EQ(*readFile(path), "old");
    EXPECT_EQ(filesIn(at), 1u);
    const Status full = writeFileSafely("/dev/full", "text");
    ASSERT_FALSE(full);
    EXPECT_NE(full.error().message.find("No space left"), std::string::npos);
}

TEST(SafeFile, WhatCannotBeWrittenIsKnownBefore) {
    const fs::path at = test::ownFolder();
    EXPECT_TRUE(checkWritable((at / "new.txt").string()));
    EXPECT_EQ(filesIn(at), 0u) << "the check leaves nothing";
    EXPECT_TRUE(checkWritable("/dev/null"));
    for (const char* path : {"/proc/none/a.txt", "/no/such/folder/a.txt", at.c_str()}) {
        const Status writable = checkWritable(path);
        ASSERT_FALSE(writable) << path;
        EXPECT_NE(writable.error().message.find(path), std::string::npos);
    }
}

TEST(SafeFile, PipesAndEndlessFilesAreNotWaitedFor) {
    const fs::path at = test::ownFolder();
    const std::string pipe = at / "pipe", zero = at / "zero";
    ASSERT_EQ(mkfifo(pipe.c_str(), 0600), 0);
    fs::create_symlink("/dev/zero", zero);
    for (const std::string& path : {pipe, zero, at.string()}) {
        const auto text = readFile(path);
        ASSERT_FALSE(text) << path;
        EXPECT_EQ(text.error().message, path + ": it is not a file");
    }
    const Status unread = writeFileSafely(pipe, "text");
    ASSERT_FALSE(unread);
    EXPECT_EQ(unread.error().message, "cannot write " + pipe + ": nobody reads from it");
}

TEST(SafeFile, ReadsNoMoreThanAllowed) {
    const std::string path = test::ownFolder() / "large.txt";
    ASSERT_TRUE(writeFileSafely(path, letters('x', 3000)));
    EXPECT_EQ(readFile(path, 3000)->size(), 3000u);
    EXPECT_FALSE(readFile(path, 2999));
    // A file of the system's says it is empty and has text all the same.
    EXPECT_GT(readFile("/proc/self/status")->size(), 100u);
    EXPECT_FALSE(readFile("/proc/self/status", 10));
}

}  // namespace
}  // namespace ag
