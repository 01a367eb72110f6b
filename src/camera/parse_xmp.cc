// SPDX-License-Identifier: Apache-2.0
#include <expat.h>

#include <algorithm>
#include <cctype>
#include <memory>
#include <string>
#include <type_traits>
#include <vector>

#include "camera/picture_blocks.h"

namespace ridgeline {
namespace {

// A structure in a structure in a structure is no fact about a picture.
constexpr std::size_t kDeepest = 64;

bool Drop(std::string_view& text, std::string_view head) {
  if (!text.starts_with(head)) return false;
  text.remove_prefix(head.size());
  return true;
}

// Expat's "URI name" with the URI bare.
std::string BareName(std::string_view name) {
  const std::size_t blank = name.rfind(' ');
  if (blank == std::string_view::npos) return std::string(name);
  std::string_view uri = name.substr(0, blank);
  if (!Drop(uri, "http://")) Drop(uri, "https://");
  Drop(uri, "www.");
  while (!uri.empty() && (uri.back() == '/' || uri.back() == '#')) uri.remove_suffix(1);
  std::string bare(uri);
  for (char& c : bare) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return bare + std::string(name.substr(blank));
}

// RDF's own elements (Description, Seq, li) and the packet's frame name no property.
bool IsFrame(std::string_view bare) {
  return bare.find("1999/02/22-rdf-syntax-ns ") != std::string_view::npos ||
         bare.starts_with("adobe:ns:meta ");
}

struct Parsing {
  XmpProperties properties;
  std::vector<std::string> path;  // of the open elements; "" for frames
  std::string text;               // since the last tag

  // The open property; of a structure's members only the outermost has its namespace.
  std::string Open() const {
    std::string key;
    for (const std::string& part : path) {
      if (part.empty()) continue;
      key += key.empty() ? part : "/" + part.substr(part.rfind(' ') + 1);
    }
    return key;
  }
};

void XMLCALL OnStart(void* data, const XML_Char* name, const XML_Char** attributes) {
  auto& parsing = *static_cast<Parsing*>(data);
  parsing.text.clear();
  const std::string bare = BareName(name);
  const bool deep = parsing.path.size() >= kDeepest;
  parsing.path.push_back(deep || IsFrame(bare) ? std::string() : bare);
  if (deep) return;
  const std::string open = parsing.Open();
  for (; *attributes != nullptr; attributes += 2) {
    const std::string attribute = BareName(attributes[0]);
    if (IsFrame(attribute)) continue;
    const std::string key =
        open.empty() ? attribute : open + "/" + attribute.substr(attribute.rfind(' ') + 1);
    parsing.properties.emplace(key, attributes[1]);
  }
}

void XMLCALL OnEnd(void* data, const XML_Char* /*name*/) {
  auto& parsing = *static_cast<Parsing*>(data);
  constexpr const char* kBlanks = " \t\r\n";
  const std::size_t first = parsing.text.find_first_not_of(kBlanks);
  if (first != std::string::npos && parsing.path.size() <= kDeepest) {
    const std::size_t last = parsing.text.find_last_not_of(kBlanks);
    parsing.properties.emplace(parsing.Open(), parsing.text.substr(first, last - first + 1));
  }
  parsing.path.pop_back();
  parsing.text.clear();
}

void XMLCALL OnText(void* data, const XML_Char* text, int size) {
  static_cast<Parsing*>(data)->text.append(text, static_cast<std::size_t>(size));
}

// Where the XML begins: some cameras put a text before it.
std::string_view FromItsBeginning(std::string_view packet) {
  std::size_t first = packet.size();
  for (const char* head : {"<?xpacket", "<?xml", "<x:xmpmeta", "<x:xapmeta", "<rdf:RDF"}) {
    first = std::min(first, packet.find(head));
  }
  if (first == packet.size()) first = std::min(packet.find('<'), packet.size());
  return packet.substr(first);
}

}  // namespace

XmpProperties ParseXmp(std::string_view packet) {
  Parsing parsing;
  const std::unique_ptr<std::remove_pointer_t<XML_Parser>, decltype(&XML_ParserFree)> parser(
      XML_ParserCreateNS(nullptr, ' '), XML_ParserFree);
  XML_SetUserData(parser.get(), &parsing);
  XML_SetElementHandler(parser.get(), OnStart, OnEnd);
  XML_SetCharacterDataHandler(parser.get(), OnText);
  packet = FromItsBeginning(packet);
  // Padding and a trailing zero after the packet are no matter.
  packet = packet.substr(0, packet.find('\0'));
  constexpr std::size_t kMostBytes = std::size_t{64} << 20;
  packet = packet.substr(0, kMostBytes);
  XML_Parse(parser.get(), packet.data(), static_cast<int>(packet.size()), XML_TRUE);
  return parsing.properties;
}

}  // namespace ridgeline
