#pragma once

#include <string>
#include <string_view>
#include <vector>

#include <toml++/toml.h>

namespace sandstroke {

// The tables of a list ([[stone]]) are named by their places, counted from 1: stone.1.radius.

std::vector<std::string> key_parts(std::string_view key);

/// True for a part that is a place in a list.
bool is_place(std::string_view part);

/// True for an array of tables, or of nothing.
bool is_list(const toml::node& node);

/// What a table holds under this name, or a list at this place; null: nothing.
toml::node* child(toml::node& parent, const std::string& part);
const toml::node* child(const toml::node& parent, const std::string& part);

/// The key of a list's first table: stone.1.radius for stone.3.radius. Others stay as they are.
std::string at_first_places(std::string_view key);

/// The text with the places of `key`, where it names those of the first tables.
std::string at_places_of(std::string_view key, std::string text);

}  // namespace sandstroke
