#pragma once

#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

namespace flexspline::reports {

/// Fields of an artefact. What is absent or null is empty, NaN or false: an artefact with a hole
/// is drawn with a hole.
std::string text_in(const nlohmann::json& object, const char* key);
double number_in(const nlohmann::json& object, const char* key);
bool flag_in(const nlohmann::json& object, const char* key);
std::vector<double> numbers_in(const nlohmann::json& object, const char* key);
std::vector<std::string> texts_in(const nlohmann::json& object, const char* key);

/// The array or object under a key; an empty one where it is absent or null.
const nlohmann::json& member(const nlohmann::json& object, const char* key);

}  // namespace flexspline::reports
