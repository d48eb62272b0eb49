// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <algorithm>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <tuple>
#include <type_traits>
#include <utility>
#include <vector>

#include "droplet/error.h"
#include "droplet/version.h"

namespace binding {

/// Pointers to all members of a struct, as the tuple `list`; specialised for structs that are pickled.
template <typename Struct>
struct Members;

/// Value of any member.
struct Anything {
    template <typename Value>
    operator Value() const;
};

/// Number of members of a struct.
template <typename Struct, typename... Found>
constexpr std::size_t memberCount()
{
    if constexpr (requires { Struct{Found{}..., Anything{}}; }) {
        return memberCount<Struct, Found..., Anything>();
    } else {
        return sizeof...(Found);
    }
}

template <typename Value>
concept Structured = requires
{
    Members<Value>::list;
};

template <typename Value>
constexpr bool is_vector = false;
template <typename Item>
constexpr bool is_vector<std::vector<Item>> = true;
template <typename Value>
constexpr bool is_optional = false;
template <typename Item>
constexpr bool is_optional<std::optional<Item>> = true;

/// Value as objects that pickle knows: structs become tuples of their members, vectors of plain numbers
/// their bytes.
template <typename Value>
pybind11::object stateOf(const Value& value)
{
    namespace py = pybind11;
    if constexpr (std::is_enum_v<Value>) {
        return py::int_(static_cast<std::underlying_type_t<Value>>(value));
    } else if constexpr (std::is_arithmetic_v<Value>) {
        return py::cast(value);
    } else if constexpr (std::is_same_v<Value, std::string>) {
        return py::bytes(value);  // a path need not be UTF-8
    } else if constexpr (is_optional<Value>) {
        return value ? stateOf(*value) : py::none();
    } else if constexpr (is_vector<Value>) {
        using Item = typename Value::value_type;
        if constexpr (std::is_trivially_copyable_v<Item> && !Structured<Item>) {
            return py::bytes(reinterpret_cast<const char*>(value.data()), value.size() * sizeof(Item));
        } else {
            py::list items;
            for (const Item& item : value) {
                items.append(stateOf(item));
            }
            return items;
        }
    } else {
        static_assert(memberCount<Value>() == std::tuple_size_v<decltype(Members<Value>::list)>,
                      "Members<Value> lacks a member");
        return std::apply([&](auto... members) -> py::object { return py::make_tuple(stateOf(value.*members)...); },
                          Members<Value>::list);
    }
}

/// Value of a state.
/// @throws pybind11::cast_error, pybind11::error_already_set  it is the state of another type
template <typename Value>
Value valueOf(const pybind11::handle& state)
{
    namespace py = pybind11;
    if constexpr (std::is_enum_v<Value>) {
        return static_cast<Value>(state.cast<std::underlying_type_t<Value>>());
    } else if constexpr (std::is_arithmetic_v<Value> || std::is_same_v<Value, std::string>) {
        return state.cast<Value>();
    } else if constexpr (is_optional<Value>) {
        return state.is_none() ? Value() : Value(valueOf<typename Value::value_type>(state));
    } else if constexpr (is_vector<Value>) {
        using Item = typename Value::value_type;
        Value items;
        if constexpr (std::is_trivially_copyable_v<Item> && !Structured<Item>) {
            const auto bytes = state.cast<std::string_view>();
            items.resize(bytes.size() / sizeof(Item));
            std::copy_n(bytes.data(), items.size() * sizeof(Item), reinterpret_cast<char*>(items.data()));
        } else {
            for (const py::handle& item : state) {
                items.push_back(valueOf<Item>(item));
            }
        }
        return items;
    } else {
        const auto states = state.cast<py::tuple>();
        Value value;
        std::apply(
            [&](auto... members) {
                std::size_t k = 0;
                ((value.*members = valueOf<std::remove_cvref_t<decltype(value.*members)>>(states[k++])), ...);
            },
            Members<Value>::list);
        return value;
    }
}

/// Attributes of an object in Python, without its report, which is made again.
inline pybind11::dict attributesOf(const pybind11::object& self)
{
    pybind11::dict attributes(self.attr("__dict__").attr("copy")());
    attributes.attr("pop")("_report", pybind11::none());
    return attributes;
}

/// State of an object for pickle: it is read by the same version alone.
inline pybind11::tuple pickled(const pybind11::object& state)
{
    return pybind11::make_tuple(droplet::kVersion, state);
}

/// State in what pickled() made.
/// @throws droplet::Error InvalidInput: another version made it
inline pybind11::object unpickled(const pybind11::tuple& pickle)
{
    const auto version = pickle[0].cast<std::string>();
    if (version != droplet::kVersion) {
        throw droplet::Error(droplet::ErrorCode::InvalidInput, "the pickle is of version " + version +
                                                                   " of the package, this is version " +
                                                                   droplet::kVersion + "; files fit all versions");
    }
    return pickle[1];
}

}  // namespace binding
