// The registry of tunables: plain structs keep the values, the registry knows their names, ranges, units and
// help. One registration gives `--set group.name=value`, `--list-settings` and the UI.
#pragma once

#include <cstdint>
#include <initializer_list>
#include <string>
#include <string_view>
#include <type_traits>
#include <variant>
#include <vector>

#include "engine/core/result.h"

namespace ag {

struct SettingInfo {
    std::string group, name;
    double min = 0, max = 0;  // of numbers
    std::string unit;
    std::string help;
    std::vector<std::string> choices;  // of enumerations, by value from 0
};

struct Setting {
    SettingInfo info;
    std::variant<bool*, int32_t*, uint32_t*, float*> value;  // enumerations are uint32_t with choices
    double defaultValue = 0;
};

class Settings {
  public:
    // Values must outlive the registry. Names are unique; defaults are what the value holds now.
    template <class T>
    void add(SettingInfo info, T* value) {
        if constexpr (std::is_enum_v<T>) {
            static_assert(std::is_same_v<std::underlying_type_t<T>, uint32_t>);
            insert(std::move(info), reinterpret_cast<uint32_t*>(value));
        } else {
            insert(std::move(info), value);
        }
    }

    // "group.name=value"; says in one sentence what is wrong with it.
    Status set(std::string_view assignment);
    const std::vector<Setting>& all() const { return settings_; }
    std::string table() const;  // one line a setting: name, default, range, unit, help

  private:
    void insert(SettingInfo info, std::variant<bool*, int32_t*, uint32_t*, float*> value);

    std::vector<Setting> settings_;
};

double settingValue(const Setting& setting);
std::string settingText(const Setting& setting, double value);

}  // namespace ag
