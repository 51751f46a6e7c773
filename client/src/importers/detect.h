// Finds out what kind of file a user has given.
#pragma once

#include <absl/status/statusor.h>

#include <string>

#include "isofield/import.h"

namespace isofield {

// The kinds of files that can be read. A scene is JSON or a binary message.
enum class FileKind { kSceneJson, kSceneMessage, kSwc, kPdb, kMmcif, kXyz, kPoints };

// Returns the kind of a file. The content decides where it is unmistakable (molecules, neurons, scenes and files that
// cannot be read). Where more than one reader could take it, the ending of its name decides. Where the ending tells
// nothing either, a line of three numbers makes it points.
//
// INVALID_ARGUMENT: isofield cannot read the file; the message says what the file is, where that is known, and which
// files can be read.
absl::StatusOr<FileKind> detect_kind(const std::string& content, const std::string& path);

}  // namespace isofield
