// The services by which a federate registers, discovers, requests and deletes objects (IEEE
// 1516.1-2010, clause 6).
#pragma once

#include <string_view>

#include "rti/federate/ambassador_basis.h"
#include "rti/federate/delivery/residual_reader.h"
#include "rti/federate/delivery/update_arrivals.h"
#include "rti/federate/read_context.h"
#include "rti/federate/services/federate_declarations.h"
#include "rti/federate/services/instance_names.h"

namespace rink::rti {

class FederateObjects {
 public:
  struct Uses {
    const DeclaredClasses& classes;
    const FederateDeclarations& declarations;
    ObjectBook& book;
    InstanceNames& names;
    OwnershipBook& ownership;
    RegionBook& regions;
    UpdateArrivals& arrivals;
    Sparing& sparing;
    UpdateSender& sender;
    ResidualReader& residuals;
  };
  FederateObjects(const AmbassadorBasis& basis, const Uses& uses) : basis_(basis), uses_(uses) {}

  /// Empty if all handles are in use.
  ObjectHandle register_instance(ObjectClassHandle object_class, std::string_view name);
  void delete_instance(ObjectHandle object);
  void forget_instance(ObjectHandle object);
  void request_update(ObjectClassHandle object_class, AttributeSet attributes, Bytes tag);
  void request_update(ObjectHandle object, AttributeSet attributes, Bytes tag);
  /// Throws ObjectInstanceNotKnown.
  ObjectClassHandle class_of(ObjectHandle object) const;

  bool handle_further_block(Reader& reader);
  bool handle_discovery(Reader& reader);
  bool handle_removal(Reader& reader, const ReadContext& context);
  bool handle_scope(Reader& reader, bool is_in);
  bool handle_request(Reader& reader);
  /// Discovers an object; false if that may not be. Without a name it has the default one.
  bool discover(ObjectHandle object, std::uint16_t object_class, std::string_view name);
  /// Notes that a known object of the class comes into scope or leaves it.
  void change_scope(ObjectHandle object, std::uint16_t object_class, bool is_in);

 private:
  void forget(ObjectHandle object);

  AmbassadorBasis basis_;
  Uses uses_;
};

}  // namespace rink::rti
