#include "http_client.hpp"

#include <memory>

#include "wire_client.hpp"

namespace poolhall::net_tests {

HttpAnswer http_call(std::uint16_t port, const HttpCall& call) {
  std::string request = call.method + " " + call.path + " HTTP/1.1\r\nHost: " + call.host +
                        "\r\nConnection: close\r\n";
  if (!call.token.empty()) {
    request += "Authorization: Bearer " + call.token + "\r\n";
  }
  for (const std::string& header : call.headers) {
    request += header + "\r\n";
  }
  if (!call.body.empty()) {
    request += "Content-Length: " + std::to_string(call.body.size()) + "\r\n";
  }
  const auto client = call.ca_file.empty() ? std::make_unique<WireClient>(port)
                                           : std::make_unique<WireClient>(port, call.ca_file);
  client->send_bytes(request + "\r\n" + call.body);
  const std::string all = client->read_all();
  HttpAnswer answer;
  const auto end = all.find("\r\n\r\n");
  if (end == std::string::npos || all.size() < 12) {
    throw std::runtime_error("no HTTP answer: " + all);
  }
  answer.status = std::stoi(all.substr(9, 3));
  answer.head = all.substr(0, end);
  answer.body = all.substr(end + 4);
  return answer;
}

std::string member(const std::string& json, const std::string& key) {
  const std::string lead = "\"" + key + "\":\"";
  const auto begin = json.find(lead);
  if (begin == std::string::npos) {
    return "";
  }
  const auto from = begin + lead.size();
  return json.substr(from, json.find('"', from) - from);
}

}  // namespace poolhall::net_tests
