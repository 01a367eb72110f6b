// SPDX-License-Identifier: Apache-2.0
#include "city/format/xml_stream.h"

#include <expat.h>
#include <iconv.h>

#include <exception>
#include <memory>
#include <string>

#include "base/error.h"

namespace ridgeline {
namespace {

struct Session {
  XML_Parser parser = nullptr;
  XmlHandler* handler = nullptr;
  std::exception_ptr error;
  bool entities = false;
};

// Exceptions must not cross the C parser: they are kept and rethrown after it has stopped.
template <typename Body>
void Guard(Session& session, const Body& body) {
  if (session.error) return;
  try {
    body();
  } catch (...) {
    session.error = std::current_exception();
    XML_StopParser(session.parser, XML_FALSE);
  }
}

void XMLCALL OnStart(void* user, const XML_Char* name, const XML_Char** attributes) {
  Session& session = *static_cast<Session*>(user);
  Guard(session, [&] { session.handler->Start(name, XmlAttributes(attributes)); });
}

void XMLCALL OnEnd(void* user, const XML_Char* name) {
  Session& session = *static_cast<Session*>(user);
  Guard(session, [&] { session.handler->End(name); });
}

void XMLCALL OnText(void* user, const XML_Char* text, int size) {
  Session& session = *static_cast<Session*>(user);
  if (!session.handler->WantsText()) return;
  Guard(session,
        [&] { session.handler->Text(std::string_view(text, static_cast<std::size_t>(size))); });
}

void XMLCALL OnEntity(void* user,
                      const XML_Char*,
                      int,
                      const XML_Char*,
                      int,
                      const XML_Char*,
                      const XML_Char*,
                      const XML_Char*,
                      const XML_Char*) {
  Session& session = *static_cast<Session*>(user);
  session.entities = true;
  XML_StopParser(session.parser, XML_FALSE);
}

// Any single-byte encoding that iconv knows (windows-1252, ISO-8859-15, ...).
int XMLCALL OnEncoding(void*, const XML_Char* name, XML_Encoding* info) {
  const iconv_t converter = iconv_open("UCS-4LE", name);
  if (converter == reinterpret_cast<iconv_t>(-1)) return XML_STATUS_ERROR;
  int known = 0;
  for (int byte = 0; byte < 256; ++byte) {
    char in = static_cast<char>(byte);
    std::uint32_t code = 0;
    char* in_pointer = &in;
    char* out_pointer = reinterpret_cast<char*>(&code);
    std::size_t in_left = 1;
    std::size_t out_left = sizeof(code);
    iconv(converter, nullptr, nullptr, nullptr, nullptr);
    const bool ok = iconv(converter, &in_pointer, &in_left, &out_pointer, &out_left) !=
                        static_cast<std::size_t>(-1) &&
                    out_left == 0;
    info->map[byte] = ok ? static_cast<int>(code) : -1;
    known += ok ? 1 : 0;
  }
  iconv_close(converter);
  info->data = nullptr;
  info->convert = nullptr;
  info->release = nullptr;
  // Multi-byte encodings leave their lead bytes unknown: they are refused, not misread.
  return known >= 200 ? XML_STATUS_OK : XML_STATUS_ERROR;
}

[[noreturn]] void Fail(const std::string& file, XML_Parser parser, bool anything_parsed) {
  const XML_Error code = XML_GetErrorCode(parser);
  const std::string line = "line " + std::to_string(XML_GetCurrentLineNumber(parser));
  switch (code) {
    case XML_ERROR_NO_ELEMENTS:
      if (!anything_parsed) throw InputError(file, "", "an empty file", "a CityGML document");
      [[fallthrough]];
    case XML_ERROR_UNCLOSED_TOKEN:
    case XML_ERROR_PARTIAL_CHAR:
    case XML_ERROR_UNCLOSED_CDATA_SECTION:
      throw InputError(
          file, line, "a file that ends early", "a whole document (was the download cut off?)");
    case XML_ERROR_UNKNOWN_ENCODING:
      throw InputError(file,
                       line,
                       "an unknown text encoding",
                       "UTF-8, UTF-16 or a single-byte encoding such as windows-1252");
    default:
      throw InputError(file,
                       line,
                       std::string("text that is not XML (") + XML_ErrorString(code) + ")",
                       "a CityGML document");
  }
}

}  // namespace

std::string_view XmlAttributes::Local(std::string_view name) const {
  for (const char** pair = pairs_; *pair != nullptr; pair += 2) {
    if (LocalName(pair[0]) == name) return pair[1];
  }
  return {};
}

unsigned long XmlLine(const void* parser) {
  return XML_GetCurrentLineNumber(static_cast<XML_Parser>(const_cast<void*>(parser)));
}

void ParseXml(InputFile& file, XmlHandler& handler) {
  const std::unique_ptr<XML_ParserStruct, decltype(&XML_ParserFree)> parser(
      XML_ParserCreate(nullptr), XML_ParserFree);
  Session session{parser.get(), &handler, nullptr, false};
  XML_SetUserData(parser.get(), &session);
  XML_SetElementHandler(parser.get(), OnStart, OnEnd);
  XML_SetCharacterDataHandler(parser.get(), OnText);
  XML_SetEntityDeclHandler(parser.get(), OnEntity);
  XML_SetUnknownEncodingHandler(parser.get(), OnEncoding, nullptr);
  handler.SetLineSource(parser.get());

  constexpr int kChunk = 1 << 18;
  bool anything_parsed = false;
  for (bool last = false; !last;) {
    void* const buffer = XML_GetBuffer(parser.get(), kChunk);
    const std::size_t count = file.Read(static_cast<char*>(buffer), kChunk);
    last = count == 0;
    const XML_Status status =
        XML_ParseBuffer(parser.get(), static_cast<int>(count), last ? XML_TRUE : XML_FALSE);
    if (session.error) std::rethrow_exception(session.error);
    if (session.entities) {
      throw InputError(file.name(),
                       "line " + std::to_string(XML_GetCurrentLineNumber(parser.get())),
                       "a document type that declares entities",
                       "plain CityGML without entities");
    }
    anything_parsed = anything_parsed || count > 0;
    if (status != XML_STATUS_OK) Fail(file.name(), parser.get(), anything_parsed);
  }
}

}  // namespace ridgeline
