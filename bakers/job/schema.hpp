#pragma once
// A JSON Schema (draft-07) that explains itself. valijson judges; the words are ours.

#include <string>
#include <string_view>
#include <vector>

#include "bakers/baker.hpp"

namespace pbrbake::job {

/// A schema document and what can be asked of it. `node` is always a part of that document.
class Schema {
  public:
    explicit Schema(Json root) : root_(std::move(root)) {}

    const Json& root() const { return root_; }
    /// The node that `$ref`, or an `allOf` of a single `$ref`, stands for; else the node itself.
    const Json& resolve(const Json& node) const;
    /// A keyword of a node ("description", "default"), its own or of what it refers to; null if there is
    /// none.
    const Json* keyword(const Json& node, const char* name) const;

    /// Whether a value is valid against a node: valijson's word.
    bool accepts(const Json& value, const Json& node) const;
    /// Every mistake of a value, each at the innermost place that can be named, in the order of the schema.
    std::vector<Mistake> mistakes(const Json& value) const;
    /// Fills in the defaults of absent properties, and puts properties into the schema's order.
    void complete(Json& value) const { complete(value, root_); }

    /// What a node allows, in words: `integer 1 to 4096, or an array of 2 of those`.
    std::string describe(const Json& node) const;

  private:
    void complete(Json& value, const Json& node) const;
    void explain(const Json& value, const Json& node, const std::string& at, std::vector<Mistake>& out) const;
    void explain_object(const Json& value, const Json& node, const std::string& at,
                        std::vector<Mistake>& out) const;
    void explain_conditions(const Json& value, const Json& node, const std::string& at,
                            std::vector<Mistake>& out) const;
    std::string refusal(const Json& value, const Json& node) const;
    std::string describe_range(const Json& node, const char* type) const;
    std::string describe_array(const Json& node) const;

    Json root_;
};

/// The schema of job files, schemas/job.schema.json, which is part of the binary.
const Schema& job_schema();

/// A value as it stands in a message: JSON on one line, at most 60 characters.
std::string shown(const Json& value);

/// A JSON pointer one step further: "/bakes" and "0" give "/bakes/0"; escapes ~ and /.
std::string step(const std::string& pointer, std::string_view token);

}  // namespace pbrbake::job
