// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string_view>

#include "city/format/input_file.h"

namespace ridgeline {

// Attributes of an element by qualified name.
class XmlAttributes {
 public:
  explicit XmlAttributes(const char** pairs) : pairs_(pairs) {}
  // Value by local name ("id" finds gml:id); empty if absent.
  std::string_view Local(std::string_view name) const;
  const char** pairs() const { return pairs_; }

 private:
  const char** pairs_;
};

// The local part of a qualified name.
inline std::string_view LocalName(std::string_view qualified) {
  const std::size_t colon = qualified.rfind(':');
  return colon == std::string_view::npos ? qualified : qualified.substr(colon + 1);
}

class XmlHandler {
 public:
  virtual ~XmlHandler() = default;
  virtual void Start(std::string_view name, const XmlAttributes& attributes) = 0;
  virtual void End(std::string_view name) = 0;
  // Text between tags, in pieces of any length; only asked for while WantsText().
  virtual void Text(std::string_view text) = 0;
  virtual bool WantsText() const = 0;
  // Set before the first call: gives the current line for messages.
  virtual void SetLineSource(const void* parser) = 0;
};

// Line of the parser given to SetLineSource.
unsigned long XmlLine(const void* parser);

// Streams a document through the handler in bounded memory. Entities are not accepted and nothing
// outside the file is loaded. Throws InputError with the line for text that is not well-formed, for
// a file that ends early, and for unknown encodings; exceptions of the handler pass through.
void ParseXml(InputFile& file, XmlHandler& handler);

}  // namespace ridgeline
