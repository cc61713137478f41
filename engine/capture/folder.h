// A capture's folder: all its files are made beside their places and then put there, so that what goes wrong
// leaves the folder as it was.
#pragma once

#include <set>
#include <string>
#include <string_view>

#include "engine/core/image.h"

namespace ag::capture {

class Folder {
  public:
    // Makes the folder, and in it the place where files wait. Fails at once where nothing can be written.
    static Result<Folder> open(const std::string& path);
    ~Folder();  // what was not committed goes
    Folder(Folder&& other) noexcept;
    Folder& operator=(Folder&&) = delete;

    // Where somebody else is to make the file; in its place with the others.
    std::string place(const std::string& name);
    Status writeText(const std::string& name, std::string_view text);
    Status writeImage(const std::string& name, const Image& image);
    Result<std::string> readBack(const std::string& name) const;  // a file just written
    Status commit();

  private:
    Folder() = default;
    std::string path_, waiting_;
    bool made_ = false;  // the folder was not there before
    std::set<std::string> names_;
};

}  // namespace ag::capture
