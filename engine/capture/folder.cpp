#include "engine/capture/folder.h"

#include <fmt/format.h>
#include <signal.h>
#include <unistd.h>

#include <cerrno>
#include <filesystem>

#include "engine/core/number.h"
#include "engine/core/safe_file.h"

namespace ag::capture {
namespace fs = std::filesystem;

namespace {

constexpr const char* kWaiting = ".unfinished-";  // and the number of the process

// What captures that were killed have left.
void removeAbandoned(const std::string& path) {
    std::error_code ignored;
    for (const fs::directory_entry& entry : fs::directory_iterator(path, ignored)) {
        const std::string name = entry.path().filename().string();
        if (!name.starts_with(kWaiting)) continue;
        const auto process = parseNumber(name.substr(std::string_view(kWaiting).size()), 1, 1 << 30, true);
        const bool runs = process && (::kill(pid_t(*process), 0) == 0 || errno == EPERM);
        if (!runs || pid_t(*process) == ::getpid()) fs::remove_all(entry.path(), ignored);
    }
}

}  // namespace

Result<Folder> Folder::open(const std::string& path) {
    Folder folder;
    std::error_code error;
    folder.path_ = path;
    folder.made_ = !fs::exists(path, error);
    fs::create_directories(path, error);
    if (error) return Error{fmt::format("cannot make the folder {}: {}", path, error.message())};
    removeAbandoned(path);
    const std::string waiting = fmt::format("{}/{}{}", path, kWaiting, ::getpid());
    if (fs::create_directory(waiting, error); error)
        return Error{fmt::format("cannot write in {}: {}", path, error.message())};
    folder.waiting_ = waiting;
    return folder;
}

Folder::Folder(Folder&& other) noexcept
    : path_(std::move(other.path_)),
      waiting_(std::exchange(other.waiting_, {})),
      made_(other.made_),
      names_(std::move(other.names_)) {}

Folder::~Folder() {
    if (waiting_.empty()) return;
    std::error_code ignored;
    fs::remove_all(waiting_, ignored);
    if (made_) fs::remove(path_, ignored);  // only if nothing is in it
}

namespace {

// The place where the file waits is nobody's business.
Status said(const Status& status, const std::string& waiting, const std::string& path) {
    if (status) return Ok{};
    std::string sentence = status.error().message;
    if (const size_t at = sentence.find(waiting); at != std::string::npos)
        sentence.replace(at, waiting.size(), path);
    return Error{sentence};
}

}  // namespace

std::string Folder::place(const std::string& name) {
    names_.insert(name);
    return waiting_ + "/" + name;
}

Status Folder::writeText(const std::string& name, std::string_view text) {
    return said(writeFileSafely(place(name), text), waiting_, path_);
}

Status Folder::writeImage(const std::string& name, const Image& image) {
    return said(saveImage(image, place(name)), waiting_, path_);
}

Result<std::string> Folder::readBack(const std::string& name) const {
    return readFile(waiting_ + "/" + name);
}

Status Folder::commit() {
    for (const std::string& name : names_) {
        std::error_code error;
        fs::rename(waiting_ + "/" + name, path_ + "/" + name, error);
        if (error) return Error{fmt::format("cannot write {}/{}: {}", path_, name, error.message())};
    }
    std::error_code ignored;
    fs::remove_all(waiting_, ignored);
    waiting_.clear();
    return Ok{};
}

}  // namespace ag::capture
