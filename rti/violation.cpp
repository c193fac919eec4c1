// The words for violations.
#include "rti/violation.h"

namespace rink::rti {

const char* to_string(Violation violation) {
  switch (violation) {
    case Violation::malformed:
      return "malformed";
    case Violation::oversized:
      return "oversized";
    case Violation::wrong_phase:
      return "wrong phase";
    case Violation::unknown_name:
      return "unknown name";
    case Violation::undeclared:
      return "undeclared";
    case Violation::not_owned:
      return "not owned";
    case Violation::over_limit:
      return "over limit";
    case Violation::silent:
      return "silent";
    case Violation::refused:
      return "refused";
    case Violation::untimely:
      return "untimely";
  }
  return "unknown violation";
}

const char* explain(Violation violation) {
  switch (violation) {
    case Violation::malformed:
      return "it sent bytes that are no message, or a value out of its range";
    case Violation::oversized:
      return "it sent a frame longer than allowed";
    case Violation::wrong_phase:
      return "it asked to join a second time";
    case Violation::unknown_name:
      return "it named a class, attribute, object, region or label that does not exist";
    case Violation::undeclared:
      return "it used a class or an attribute that it had not published";
    case Violation::not_owned:
      return "it updated or deleted what another federate owns";
    case Violation::over_limit:
      return "it registered or sent more than the federation allows";
    case Violation::silent:
      return "it was silent for too long";
    case Violation::refused:
      return "its join was refused";
    case Violation::untimely:
      return "it used a time that its logical time forbids";
  }
  return "it broke a rule of the protocol";
}

}  // namespace rink::rti
