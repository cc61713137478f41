#include "engine/core/settings.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "engine/core/near_name.h"
#include "engine/core/number.h"
#include "engine/core/setting_fields.h"

namespace ag {
namespace {

std::string fullName(const Setting& s) {
    return s.info.group + "." + s.info.name;
}

std::optional<double> parseValue(const Setting& s, std::string_view text) {
    if (std::holds_alternative<bool*>(s.value)) {
        if (text == "on" || text == "true" || text == "1") return 1;
        if (text == "off" || text == "false" || text == "0") return 0;
        return std::nullopt;
    }
    if (s.info.choices.empty()) return parseNumber(text);
    const auto found = std::ranges::find(s.info.choices, text);
    if (found == s.info.choices.end()) return std::nullopt;
    return double(found - s.info.choices.begin());
}

std::string allowed(const Setting& s) {
    if (std::holds_alternative<bool*>(s.value)) return "on|off";
    if (!s.info.choices.empty()) return fmt::format("{}", fmt::join(s.info.choices, "|"));
    return fmt::format("{:g}..{:g}", s.info.min, s.info.max);
}

}  // namespace

std::vector<std::string> detail::split(std::string_view choices) {
    std::vector<std::string> parts;
    while (!choices.empty()) {
        const size_t end = std::min(choices.find('|'), choices.size());
        parts.emplace_back(choices.substr(0, end));
        choices.remove_prefix(std::min(end + 1, choices.size()));
    }
    return parts;
}

double settingValue(const Setting& setting) {
    return std::visit([](auto* v) { return double(*v); }, setting.value);
}

std::string settingText(const Setting& s, double value) {
    if (std::holds_alternative<bool*>(s.value)) return value != 0 ? "on" : "off";
    if (!s.info.choices.empty()) return s.info.choices[size_t(value)];
    return fmt::format("{:g}", value);
}

void Settings::insert(SettingInfo info, std::variant<bool*, int32_t*, uint32_t*, float*> value) {
    Setting setting{.info = std::move(info), .value = value};
    setting.defaultValue = settingValue(setting);
    for (const Setting& known : settings_)
        AG_CHECK_MSG(fullName(known) != fullName(setting), fullName(setting));
    settings_.push_back(std::move(setting));
}

Status Settings::set(std::string_view assignment) {
    const size_t equals = assignment.find('=');
    if (equals == std::string_view::npos)
        return Error{fmt::format("setting '{}' is not of the form group.name=value", assignment)};
    const std::string_view name = assignment.substr(0, equals), text = assignment.substr(equals + 1);
    const auto found = std::ranges::find_if(settings_, [&](const Setting& s) { return fullName(s) == name; });
    if (found == settings_.end()) {
        std::vector<std::string> names;
        for (const Setting& known : settings_)
            names.push_back(fullName(known));
        const std::vector<std::string_view> views(names.begin(), names.end());
        const std::string_view near = nearestName(name, views);
        return Error{near.empty()
                         ? fmt::format("there is no setting '{}' (--list-settings has them all)", name)
                         : fmt::format("there is no setting '{}'; did you mean '{}'?", name, near)};
    }
    const std::optional<double> value = parseValue(*found, text);
    if (!value) return Error{fmt::format("setting {} takes {}, not '{}'", name, allowed(*found), text)};
    const bool number = found->info.choices.empty() && !std::holds_alternative<bool*>(found->value);
    const bool whole =
        !number || std::holds_alternative<float*>(found->value) || *value == std::floor(*value);
    if (number && (*value < found->info.min || *value > found->info.max || !whole))
        return Error{fmt::format("setting {} takes {}{}, not {}", name, whole ? "" : "a whole number in ",
                                 allowed(*found), text)};
    std::visit([&](auto* v) { *v = static_cast<std::remove_reference_t<decltype(*v)>>(*value); },
               found->value);
    return Ok{};
}

std::string Settings::table() const {
    std::string out;
    for (const Setting& s : settings_)
        out += fmt::format("{:<38} {:<12} {:<32} {:<10} {}\n", fullName(s), settingText(s, s.defaultValue),
                           allowed(s), s.info.unit, s.info.help);
    return out;
}

}  // namespace ag
