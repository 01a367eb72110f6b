// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace ridgeline::testing {

// An XMP packet around the attributes and the elements of one description.
inline std::string XmpPacket(const std::string& attributes, const std::string& elements = "") {
  return "<?xpacket begin=\"\xEF\xBB\xBF\" id=\"W5M0MpCehiHzreSzNTczkc9d\"?>\n"
         "<x:xmpmeta xmlns:x=\"adobe:ns:meta/\"><rdf:RDF "
         "xmlns:rdf=\"http://www.w3.org/1999/02/22-rdf-syntax-ns#\"><rdf:Description "
         "rdf:about=\"\" " +
         attributes + ">" + elements +
         "</rdf:Description></rdf:RDF></x:xmpmeta>\n<?xpacket end=\"w\"?>";
}

}  // namespace ridgeline::testing
