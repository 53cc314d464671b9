// JSON Schemas (2020-12, as OpenAPI 3.1 wants them) of what the API answers, by name. States,
// rulings and events are those of protocol/README.md and stand here as objects.
//
//   out.key("schemas").raw(openapi_schemas());
#pragma once

#include <string_view>

namespace poolhall::web {

[[nodiscard]] std::string_view openapi_schemas();

}  // namespace poolhall::web
