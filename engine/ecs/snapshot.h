// A world as bytes: save games, replays, going back. Entities keep their handles, so references between them
// hold; storage order is kept too, so a restored world goes on exactly as the saved one would have.
//
// Not in it: resources (the caller's own), and versions of columns (after restoring everything counts as
// changed). Components are known by name and size. A saved world is read on machines of the same byte order.
#pragma once

#include <filesystem>

#include "engine/core/result.h"
#include "engine/ecs/world.h"

namespace ag {

std::vector<std::byte> saveWorld(const World& world);
// Puts what was saved in place of all entities. Types it holds must have been used or registered before. On
// an error the world is as it was.
Status restoreWorld(World& world, std::span<const std::byte> bytes);

Status saveWorldFile(const World& world, const std::filesystem::path& path);
Status loadWorldFile(World& world, const std::filesystem::path& path);

}  // namespace ag
