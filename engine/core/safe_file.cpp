#include "engine/core/safe_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <cstdlib>
#include <filesystem>
#include <optional>
#include <system_error>

namespace ag {
namespace {

namespace fs = std::filesystem;

std::string reason(int error) {
    return std::generic_category().message(error);
}

Error cannotWrite(const std::string& path, const std::string& why) {
    return Error{fmt::format("cannot write {}: {}", path, why)};
}

class Descriptor {
  public:
    explicit Descriptor(int fd = -1) : fd_(fd) {}
    Descriptor(Descriptor&& other) noexcept : fd_(std::exchange(other.fd_, -1)) {}
    Descriptor& operator=(Descriptor&& other) noexcept {
        std::swap(fd_, other.fd_);
        return *this;
    }
    ~Descriptor() { close(); }
    int get() const { return fd_; }
    explicit operator bool() const { return fd_ >= 0; }
    int close() { return fd_ < 0 ? 0 : ::close(std::exchange(fd_, -1)); }

  private:
    int fd_;
};

// 0 or an errno.
int writeAll(int fd, std::string_view bytes) {
    while (!bytes.empty()) {
        const ssize_t count = ::write(fd, bytes.data(), bytes.size());
        if (count < 0 && errno == EINTR) continue;
        if (count <= 0) return count < 0 ? errno : EIO;
        bytes.remove_prefix(size_t(count));
    }
    return 0;
}

// What a path names, with links followed.
struct Target {
    std::string path;
    std::optional<mode_t> mode;  // of what is there already
    bool isStream() const { return mode && !S_ISREG(*mode) && !S_ISDIR(*mode); }
};

Target targetOf(const std::string& path) {
    Target target{.path = path};
    std::error_code error;
    if (fs::is_symlink(path, error))
        if (const fs::path end = fs::weakly_canonical(path, error); !error) target.path = end.string();
    struct stat status {};
    if (::stat(path.c_str(), &status) == 0) target.mode = status.st_mode;
    return target;
}

struct Temporary {
    std::string path;
    Descriptor file;
};

// Beside the target, of a name that no other process or thread has; with an old file's permissions.
Status makeTemporary(const std::string& path, const Target& target, Temporary& made) {
    static std::atomic<uint32_t> counter{0};
    constexpr int kTries = 64;  // a process that was killed may have had our number
    if (target.mode && S_ISDIR(*target.mode)) return cannotWrite(path, "it is a folder");
    for (int i = 0; i < kTries && !made.file; ++i) {
        made.path = fmt::format("{}.{}-{}.part", target.path, ::getpid(), counter++);
        made.file = Descriptor(::open(made.path.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666));
        if (!made.file && errno != EEXIST) return cannotWrite(path, reason(errno));
    }
    if (!made.file) return cannotWrite(path, "no temporary file can be made beside it");
    if (target.mode) ::fchmod(made.file.get(), *target.mode & 07777);
    return Ok{};
}

// So that the new name survives a power cut.
void syncFolderOf(const std::string& path) {
    const fs::path parent = fs::path(path).parent_path();
    const Descriptor folder(
        ::open(parent.empty() ? "." : parent.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
    if (folder) ::fsync(folder.get());
}

Status replaceFile(const std::string& path, const Target& target, std::string_view bytes) {
    Temporary made;
    if (const Status begun = makeTemporary(path, target, made); !begun) return begun;
    int error = writeAll(made.file.get(), bytes);
    if (!error && ::fsync(made.file.get()) != 0) error = errno;
    if (made.file.close() != 0 && !error) error = errno;
    if (!error && ::rename(made.path.c_str(), target.path.c_str()) != 0) error = errno;
    if (error) {
        ::unlink(made.path.c_str());
        return cannotWrite(path, reason(error));
    }
    syncFolderOf(target.path);
    return Ok{};
}

// A pipe that nobody reads from is refused instead of waited for.
Result<Descriptor> openStream(const std::string& path) {
    Descriptor stream(::open(path.c_str(), O_WRONLY | O_NONBLOCK | O_CLOEXEC));
    if (!stream) return cannotWrite(path, errno == ENXIO ? "nobody reads from it" : reason(errno));
    ::fcntl(stream.get(), F_SETFL, ::fcntl(stream.get(), F_GETFL) & ~O_NONBLOCK);
    return stream;
}

Status writeStream(const std::string& path, std::string_view bytes) {
    const auto stream = openStream(path);
    if (!stream) return stream.error();
    const int error = writeAll(stream->get(), bytes);
    return error ? Status(cannotWrite(path, reason(error))) : Ok{};
}

}  // namespace

Status writeFileSafely(const std::string& path, std::string_view bytes) {
    const Target target = targetOf(path);
    return target.isStream() ? writeStream(path, bytes) : replaceFile(path, target, bytes);
}

Status checkWritable(const std::string& path) {
    const Target target = targetOf(path);
    if (target.isStream()) return Ok{};
    Temporary made;
    const Status begun = makeTemporary(path, target, made);
    if (begun) ::unlink(made.path.c_str());
    return begun;
}

Status checkWritable(std::initializer_list<std::string_view> paths) {
    for (const std::string_view path : paths)
        if (!path.empty())
            if (const Status writable = checkWritable(std::string(path)); !writable) return writable;
    return Ok{};
}

Status makeFolderOf(const std::string& path) {
    const fs::path folder = fs::path(path).parent_path();
    std::error_code error;
    if (!folder.empty()) fs::create_directories(folder, error);
    if (error) return Error{fmt::format("cannot make the folder {}: {}", folder.string(), error.message())};
    return Ok{};
}

Result<std::string> readFile(const std::string& path, uint64_t mostBytes) {
    const auto refuse = [&](const std::string& why) { return Error{path + ": " + why}; };
    const Descriptor file(::open(path.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC));
    if (!file && errno == ENOENT) return refuse("the file does not exist");
    if (!file) return refuse("the file cannot be opened: " + reason(errno));
    struct stat status {};
    if (::fstat(file.get(), &status) != 0 || !S_ISREG(status.st_mode)) return refuse("it is not a file");
    const std::string tooLarge =
        fmt::format("the file is larger than the limit, {:.3g} MiB", double(mostBytes) / 1048576.0);
    if (uint64_t(status.st_size) > mostBytes) return refuse(tooLarge);
    // A file may grow while it is read, and one of the system's may be endless though its size says 0.
    std::string bytes(size_t(status.st_size) + 1, '\0');
    size_t read = 0;
    for (;;) {
        const ssize_t count = ::read(file.get(), bytes.data() + read, bytes.size() - read);
        if (count < 0 && errno == EINTR) continue;
        if (count < 0) return refuse("the file cannot be read: " + reason(errno));
        read += size_t(count);
        if (count == 0) break;
        if (read > mostBytes) return refuse(tooLarge);
        if (read == bytes.size()) bytes.resize(2 * read);
    }
    bytes.resize(read);
    return bytes;
}

bool fileExists(const std::string& path) {
    std::error_code error;
    return std::filesystem::exists(path, error);
}

std::string userFolder() {
    if (const char* config = std::getenv("XDG_CONFIG_HOME"); config && *config)
        return std::string(config) + "/afterglow";
    const char* home = std::getenv("HOME");
    return std::string(home ? home : ".") + "/.config/afterglow";
}

}  // namespace ag
