// Objects that go once the device is done with them, from where nothing may be thrown.
#pragma once

#include <memory>
#include <new>

#include "engine/gpu/context.h"

namespace ag::gpu {

// Where there is no memory even to note it, the object stays for ever instead of going while it is in use.
template <class T>
void retireOwned(Context& context, std::unique_ptr<T> object) noexcept {
    T* raw = object.release();
    if (!raw) return;
    try {
        context.retire([raw] { delete raw; });
    } catch (const std::bad_alloc&) {
    }
}

}  // namespace ag::gpu
