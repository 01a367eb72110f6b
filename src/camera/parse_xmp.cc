// SPDX-License-Identifier: Apache-2.0
#include <expat.h>

#include <cstring>
#include <memory>

#include "camera/picture_blocks.h"

namespace ridgeline {
namespace {

struct Parsing {
  XmpProperties properties;
  std::string text;  // since the last tag
};

void XMLCALL OnStart(void* data, const XML_Char* /*name*/, const XML_Char** attributes) {
  auto& parsing = *static_cast<Parsing*>(data);
  parsing.text.clear();
  for (; *attributes != nullptr; attributes += 2) {
    parsing.properties.emplace(attributes[0], attributes[1]);
  }
}

void XMLCALL OnEnd(void* data, const XML_Char* name) {
  auto& parsing = *static_cast<Parsing*>(data);
  constexpr const char* kBlanks = " \t\r\n";
  const std::size_t first = parsing.text.find_first_not_of(kBlanks);
  if (first != std::string::npos) {
    const std::size_t last = parsing.text.find_last_not_of(kBlanks);
    parsing.properties.emplace(name, parsing.text.substr(first, last - first + 1));
  }
  parsing.text.clear();
}

void XMLCALL OnText(void* data, const XML_Char* text, int size) {
  static_cast<Parsing*>(data)->text.append(text, static_cast<std::size_t>(size));
}

}  // namespace

XmpProperties ParseXmp(std::string_view packet) {
  Parsing parsing;
  const std::unique_ptr<std::remove_pointer_t<XML_Parser>, decltype(&XML_ParserFree)> parser(
      XML_ParserCreateNS(nullptr, ' '), XML_ParserFree);
  XML_SetUserData(parser.get(), &parsing);
  XML_SetElementHandler(parser.get(), OnStart, OnEnd);
  XML_SetCharacterDataHandler(parser.get(), OnText);
  // Padding and a trailing zero after the packet are no matter.
  packet = packet.substr(0, packet.find('\0'));
  XML_Parse(parser.get(), packet.data(), static_cast<int>(packet.size()), XML_TRUE);
  return parsing.properties;
}

}  // namespace ridgeline
