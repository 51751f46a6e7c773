#pragma once

#include <absl/status/statusor.h>

#include <string>

#include "isofield/import.h"

namespace isofield {

// What the readers take. A scene is JSON or a binary message.
enum class FileKind { kSceneJson, kSceneMessage, kSwc, kPdb, kMmcif, kXyz, kPoints };

// What a file holds. By its content where that is plain (molecules, neurons, scenes, and what cannot be read); where
// more than one reader could take it, by the ending of its name; else by the content alone: a line of three numbers
// makes points.
//
// INVALID_ARGUMENT: nothing that isofield reads; the message says what it is, where that is known, and what can be
// read.
absl::StatusOr<FileKind> detect_kind(const std::string& content, const std::string& path);

}  // namespace isofield
