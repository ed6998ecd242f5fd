// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

namespace tenon::engines::mujoco {

/// A scene in which the properties of a schema can matter. A property is authored where '@' stands,
/// without the line that authors it already, if there is one.
struct SettingScene {
  std::string schema;
  std::string instance;  ///< of schemas that are applied several times
  std::string text;
};

inline std::vector<SettingScene> setting_scenes() {
  return {
      {"PhysxSceneAPI", "", R"(def PhysicsScene "S" (apiSchemas = ["PhysxSceneAPI"]) {
vector3f physics:gravityDirection = (0, 0, -1)
float physics:gravityMagnitude = 10
@
}
def Cube "Ground" (apiSchemas = ["PhysicsCollisionAPI"]) {
double size = 20
double3 xformOp:translate = (0, 0, -10)
uniform token[] xformOpOrder = ["xformOp:translate"]
}
def PhysicsCollisionGroup "G" {
rel collection:colliders:includes = </B/Shape>
rel physics:filteredGroups = </H>
}
def PhysicsCollisionGroup "H" {
rel collection:colliders:includes = </Ground>
}
def Xform "B" (apiSchemas = ["PhysicsRigidBodyAPI", "PhysicsMassAPI"]) {
double3 xformOp:translate = (0, 0, 0.25)
uniform token[] xformOpOrder = ["xformOp:translate"]
float physics:mass = 2
float3 physics:diagonalInertia = (0.1, 0.2, 0.3)
vector3f physics:velocity = (1, 0.5, -1)
def Cube "Shape" (apiSchemas = ["PhysicsCollisionAPI"]) {
double size = 0.4
}

}
def Xform "C" (apiSchemas = ["PhysicsRigidBodyAPI", "PhysicsMassAPI"]) {
double3 xformOp:translate = (0.5, 3, 1)
uniform token[] xformOpOrder = ["xformOp:translate"]
float physics:mass = 2
float3 physics:diagonalInertia = (0.1, 0.2, 0.3)


}
def PhysicsRevoluteJoint "J" (apiSchemas = []) {
rel physics:body1 = </C>
point3f physics:localPos0 = (0, 3, 1)
point3f physics:localPos1 = (-0.5, 0, 0)
uniform token physics:axis = "Y"
}
)"},
      {"NewtonSceneAPI", "", R"(def PhysicsScene "S" (apiSchemas = ["NewtonSceneAPI"]) {
vector3f physics:gravityDirection = (0, 0, -1)
float physics:gravityMagnitude = 10
@
}
def Cube "Ground" (apiSchemas = ["PhysicsCollisionAPI"]) {
double size = 20
double3 xformOp:translate = (0, 0, -10)
uniform token[] xformOpOrder = ["xformOp:translate"]
}
def PhysicsCollisionGroup "G" {
rel collection:colliders:includes = </B/Shape>
rel physics:filteredGroups = </H>
}
def PhysicsCollisionGroup "H" {
rel collection:colliders:includes = </Ground>
}
def Xform "B" (apiSchemas = ["PhysicsRigidBodyAPI", "PhysicsMassAPI"]) {
double3 xformOp:translate = (0, 0, 0.25)
uniform token[] xformOpOrder = ["xformOp:translate"]
float physics:mass = 2
float3 physics:diagonalInertia = (0.1, 0.2, 0.3)
vector3f physics:velocity = (1, 0.5, -1)
def Cube "Shape" (apiSchemas = ["PhysicsCollisionAPI"]) {
double size = 0.4
}

}
def Xform "C" (apiSchemas = ["PhysicsRigidBodyAPI", "PhysicsMassAPI"]) {
double3 xformOp:translate = (0.5, 3, 1)
uniform token[] xformOpOrder = ["xformOp:translate"]
float physics:mass = 2
float3 physics:diagonalInertia = (0.1, 0.2, 0.3)


}
def PhysicsRevoluteJoint "J" (apiSchemas = []) {
rel physics:body1 = </C>
point3f physics:localPos0 = (0, 3, 1)
point3f physics:localPos1 = (-0.5, 0, 0)
uniform token physics:axis = "Y"
}
)"},
      {"MjcSceneAPI", "", R"(def PhysicsScene "S" (apiSchemas = ["MjcSceneAPI"]) {
vector3f physics:gravityDirection = (0, 0, -1)
float physics:gravityMagnitude = 10
@
}
def Cube "Ground" (apiSchemas = ["PhysicsCollisionAPI"]) {
double size = 20
double3 xformOp:translate = (0, 0, -10)
uniform token[] xformOpOrder = ["xformOp:translate"]
}
def PhysicsCollisionGroup "G" {
rel collection:colliders:includes = </B/Shape>
rel physics:filteredGroups = </H>
}
def PhysicsCollisionGroup "H" {
rel collection:colliders:includes = </Ground>
}
def Xform "B" (apiSchemas = ["PhysicsRigidBodyAPI", "PhysicsMassAPI"]) {
double3 xformOp:translate = (0, 0, 0.25)
uniform token[] xformOpOrder = ["xformOp:translate"]
float physics:mass = 2
float3 physics:diagonalInertia = (0.1, 0.2, 0.3)
vector3f physics:velocity = (1, 0.5, -1)
def Cube "Shape" (apiSchemas = ["PhysicsCollisionAPI"]) {
double size = 0.4
}

}
def Xform "C" (apiSchemas = ["PhysicsRigidBodyAPI", "PhysicsMassAPI"]) {
double3 xformOp:translate = (0.5, 3, 1)
uniform token[] xformOpOrder = ["xformOp:translate"]
float physics:mass = 2
float3 physics:diagonalInertia = (0.1, 0.2, 0.3)


}
def PhysicsRevoluteJoint "J" (apiSchemas = []) {
rel physics:body1 = </C>
point3f physics:localPos0 = (0, 3, 1)
point3f physics:localPos1 = (-0.5, 0, 0)
uniform token physics:axis = "Y"
}
)"},
      {"PhysxRigidBodyAPI", "", R"(def PhysicsScene "S" {
vector3f physics:gravityDirection = (0, 0, -1)
float physics:gravityMagnitude = 10
}
def Cube "Ground" (apiSchemas = ["PhysicsCollisionAPI"]) {
double size = 20
double3 xformOp:translate = (0, 0, -10)
uniform token[] xformOpOrder = ["xformOp:translate"]
}
def Xform "B" (apiSchemas = ["PhysicsRigidBodyAPI", "PhysicsMassAPI", "PhysxRigidBodyAPI"]) {
double3 xformOp:translate = (0, 0, 0.5)
uniform token[] xformOpOrder = ["xformOp:translate"]
float physics:mass = 2
float3 physics:diagonalInertia = (0.1, 0.2, 0.3)
vector3f physics:velocity = (1, 0.5, -1)
vector3f physics:angularVelocity = (100, 200, 150)
@
def Cube "Shape" (apiSchemas = ["PhysicsCollisionAPI"]) {
double size = 0.4
}

}
)"},
      {"PhysxCollisionAPI", "", R"(def PhysicsScene "S" {
vector3f physics:gravityDirection = (0, 0, -1)
float physics:gravityMagnitude = 10
}
def Cube "Ground" (apiSchemas = ["PhysicsCollisionAPI"]) {
double size = 20
double3 xformOp:translate = (0, 0, -10)
uniform token[] xformOpOrder = ["xformOp:translate"]
}
def Xform "B" (apiSchemas = ["PhysicsRigidBodyAPI", "PhysicsMassAPI"]) {
double3 xformOp:translate = (0, 0, 0.2)
uniform token[] xformOpOrder = ["xformOp:translate"]
float physics:mass = 2
float3 physics:diagonalInertia = (0.1, 0.2, 0.3)
vector3f physics:angularVelocity = (0, 0, 500)
def Sphere "Shape" (apiSchemas = ["PhysicsCollisionAPI", "PhysxCollisionAPI"]) {
double radius = 0.2
@
}

}
)"},
      {"NewtonCollisionAPI", "", R"(def PhysicsScene "S" {
vector3f physics:gravityDirection = (0, 0, -1)
float physics:gravityMagnitude = 10
}
def Cube "Ground" (apiSchemas = ["PhysicsCollisionAPI"]) {
double size = 20
double3 xformOp:translate = (0, 0, -10)
uniform token[] xformOpOrder = ["xformOp:translate"]
}
def Xform "B" (apiSchemas = ["PhysicsRigidBodyAPI", "PhysicsMassAPI"]) {
double3 xformOp:translate = (0, 0, 0.2)
uniform token[] xformOpOrder = ["xformOp:translate"]
float physics:mass = 2
float3 physics:diagonalInertia = (0.1, 0.2, 0.3)
vector3f physics:angularVelocity = (0, 0, 500)
def Sphere "Shape" (apiSchemas = ["PhysicsCollisionAPI", "NewtonCollisionAPI"]) {
double radius = 0.2
@
}

}
)"},
      {"MjcCollisionAPI", "", R"(def PhysicsScene "S" {
vector3f physics:gravityDirection = (0, 0, -1)
float physics:gravityMagnitude = 10
}
def Cube "Ground" (apiSchemas = ["PhysicsCollisionAPI"]) {
double size = 20
double3 xformOp:translate = (0, 0, -10)
uniform token[] xformOpOrder = ["xformOp:translate"]
}
def Xform "B" (apiSchemas = ["PhysicsRigidBodyAPI", "PhysicsMassAPI"]) {
double3 xformOp:translate = (0, 0, 0.2)
uniform token[] xformOpOrder = ["xformOp:translate"]
float physics:mass = 2
float3 physics:diagonalInertia = (0.1, 0.2, 0.3)
vector3f physics:angularVelocity = (0, 0, 500)
vector3f physics:velocity = (1, 0, 0)
def Sphere "Shape" (apiSchemas = ["PhysicsCollisionAPI", "MjcCollisionAPI"]) {
double radius = 0.2
@
}

}
)"},
      {"PhysxConvexHullCollisionAPI", "", R"(def PhysicsScene "S" {
vector3f physics:gravityDirection = (0, 0, -1)
float physics:gravityMagnitude = 10
}
def Cube "Ground" (apiSchemas = ["PhysicsCollisionAPI"]) {
double size = 20
double3 xformOp:translate = (0, 0, -10)
uniform token[] xformOpOrder = ["xformOp:translate"]
}
def Xform "B" (apiSchemas = ["PhysicsRigidBodyAPI", "PhysicsMassAPI"]) {
double3 xformOp:translate = (0, 0, 0.3)
uniform token[] xformOpOrder = ["xformOp:translate"]
float physics:mass = 2
float3 physics:diagonalInertia = (0.1, 0.2, 0.3)
vector3f physics:angularVelocity = (200, 100, 0)
def Mesh "Shape" (apiSchemas = ["PhysicsCollisionAPI", "PhysicsMeshCollisionAPI", "PhysxConvexHullCollisionAPI"]) {
uniform token subdivisionScheme = "none"
point3f[] points = [(0, 0, 0), (0.4, 0, 0), (0.4, 0.1, 0), (0.1, 0.1, 0), (0.1, 0.4, 0), (0, 0.4, 0), (0, 0, 0.2), (0.4, 0, 0.2), (0.4, 0.1, 0.2), (0.1, 0.1, 0.2), (0.1, 0.4, 0.2), (0, 0.4, 0.2)]
int[] faceVertexCounts = [4, 4, 4, 4, 4, 4, 4, 4, 4, 4]
int[] faceVertexIndices = [3, 2, 1, 0, 5, 4, 3, 0, 6, 7, 8, 9, 6, 9, 10, 11, 0, 1, 7, 6, 1, 2, 8, 7, 2, 3, 9, 8, 3, 4, 10, 9, 4, 5, 11, 10, 5, 0, 6, 11]
uniform token physics:approximation = "convexHull"
@
}

}
)"},
      {"PhysxConvexDecompositionCollisionAPI", "", R"(def PhysicsScene "S" {
vector3f physics:gravityDirection = (0, 0, -1)
float physics:gravityMagnitude = 10
}
def Cube "Ground" (apiSchemas = ["PhysicsCollisionAPI"]) {
double size = 20
double3 xformOp:translate = (0, 0, -10)
uniform token[] xformOpOrder = ["xformOp:translate"]
}
def Xform "B" (apiSchemas = ["PhysicsRigidBodyAPI", "PhysicsMassAPI"]) {
double3 xformOp:translate = (0, 0, 0.3)
uniform token[] xformOpOrder = ["xformOp:translate"]
float physics:mass = 2
float3 physics:diagonalInertia = (0.1, 0.2, 0.3)
vector3f physics:angularVelocity = (200, 100, 0)
def Mesh "Shape" (apiSchemas = ["PhysicsCollisionAPI", "PhysicsMeshCollisionAPI", "PhysxConvexDecompositionCollisionAPI"]) {
uniform token subdivisionScheme = "none"
point3f[] points = [(0, 0, 0), (0.4, 0, 0), (0.4, 0.1, 0), (0.1, 0.1, 0), (0.1, 0.4, 0), (0, 0.4, 0), (0, 0, 0.2), (0.4, 0, 0.2), (0.4, 0.1, 0.2), (0.1, 0.1, 0.2), (0.1, 0.4, 0.2), (0, 0.4, 0.2)]
int[] faceVertexCounts = [4, 4, 4, 4, 4, 4, 4, 4, 4, 4]
int[] faceVertexIndices = [3, 2, 1, 0, 5, 4, 3, 0, 6, 7, 8, 9, 6, 9, 10, 11, 0, 1, 7, 6, 1, 2, 8, 7, 2, 3, 9, 8, 3, 4, 10, 9, 4, 5, 11, 10, 5, 0, 6, 11]
uniform token physics:approximation = "convexDecomposition"
@
}

}
)"},
      {"NewtonMeshCollisionAPI", "", R"(def PhysicsScene "S" {
vector3f physics:gravityDirection = (0, 0, -1)
float physics:gravityMagnitude = 10
}
def Cube "Ground" (apiSchemas = ["PhysicsCollisionAPI"]) {
double size = 20
double3 xformOp:translate = (0, 0, -10)
uniform token[] xformOpOrder = ["xformOp:translate"]
}
def Xform "B" (apiSchemas = ["PhysicsRigidBodyAPI", "PhysicsMassAPI"]) {
double3 xformOp:translate = (0, 0, 0.3)
uniform token[] xformOpOrder = ["xformOp:translate"]
float physics:mass = 2
float3 physics:diagonalInertia = (0.1, 0.2, 0.3)
vector3f physics:angularVelocity = (200, 100, 0)
def Mesh "Shape" (apiSchemas = ["PhysicsCollisionAPI", "PhysicsMeshCollisionAPI", "NewtonMeshCollisionAPI"]) {
uniform token subdivisionScheme = "none"
point3f[] points = [(0, 0, 0), (0.4, 0, 0), (0.4, 0.1, 0), (0.1, 0.1, 0), (0.1, 0.4, 0), (0, 0.4, 0), (0, 0, 0.2), (0.4, 0, 0.2), (0.4, 0.1, 0.2), (0.1, 0.1, 0.2), (0.1, 0.4, 0.2), (0, 0.4, 0.2)]
int[] faceVertexCounts = [4, 4, 4, 4, 4, 4, 4, 4, 4, 4]
int[] faceVertexIndices = [3, 2, 1, 0, 5, 4, 3, 0, 6, 7, 8, 9, 6, 9, 10, 11, 0, 1, 7, 6, 1, 2, 8, 7, 2, 3, 9, 8, 3, 4, 10, 9, 4, 5, 11, 10, 5, 0, 6, 11]
uniform token physics:approximation = "convexHull"
@
}

}
)"},
      {"MjcMeshCollisionAPI", "", R"(def PhysicsScene "S" {
vector3f physics:gravityDirection = (0, 0, -1)
float physics:gravityMagnitude = 10
}
def Cube "Ground" (apiSchemas = ["PhysicsCollisionAPI"]) {
double size = 20
double3 xformOp:translate = (0, 0, -10)
uniform token[] xformOpOrder = ["xformOp:translate"]
}
def Xform "B" (apiSchemas = ["PhysicsRigidBodyAPI", "PhysicsMassAPI"]) {
double3 xformOp:translate = (0, 0, 0.3)
uniform token[] xformOpOrder = ["xformOp:translate"]
float physics:mass = 2
float3 physics:diagonalInertia = (0.1, 0.2, 0.3)
vector3f physics:angularVelocity = (200, 100, 0)
def Mesh "Shape" (apiSchemas = ["PhysicsCollisionAPI", "PhysicsMeshCollisionAPI", "MjcMeshCollisionAPI"]) {
uniform token subdivisionScheme = "none"
point3f[] points = [(0, 0, 0), (0.4, 0, 0), (0.4, 0.1, 0), (0.1, 0.1, 0), (0.1, 0.4, 0), (0, 0.4, 0), (0, 0, 0.2), (0.4, 0, 0.2), (0.4, 0.1, 0.2), (0.1, 0.1, 0.2), (0.1, 0.4, 0.2), (0, 0.4, 0.2)]
int[] faceVertexCounts = [4, 4, 4, 4, 4, 4, 4, 4, 4, 4]
int[] faceVertexIndices = [3, 2, 1, 0, 5, 4, 3, 0, 6, 7, 8, 9, 6, 9, 10, 11, 0, 1, 7, 6, 1, 2, 8, 7, 2, 3, 9, 8, 3, 4, 10, 9, 4, 5, 11, 10, 5, 0, 6, 11]
uniform token physics:approximation = "convexHull"
@
}

}
)"},
      {"PhysxSurfaceVelocityAPI", "", R"(def PhysicsScene "S" {
vector3f physics:gravityDirection = (0, 0, -1)
float physics:gravityMagnitude = 10
}
def Xform "A" (apiSchemas = ["PhysicsRigidBodyAPI", "PhysicsMassAPI", "PhysxSurfaceVelocityAPI"]) {
double3 xformOp:translate = (0, 0, 0)
uniform token[] xformOpOrder = ["xformOp:translate", "xformOp:orient"]
float physics:mass = 2
float3 physics:diagonalInertia = (0.1, 0.2, 0.3)
quatf xformOp:orient = (0.9238795, 0, 0, 0.3826834)
bool physics:kinematicEnabled = 1
vector3f physxSurfaceVelocity:surfaceVelocity = (1, 0.3, 0)
@
def Cube "Shape" (apiSchemas = ["PhysicsCollisionAPI"]) {
double size = 2
}

}
def Xform "B" (apiSchemas = ["PhysicsRigidBodyAPI", "PhysicsMassAPI"]) {
double3 xformOp:translate = (0.5, 0.2, 1.2)
uniform token[] xformOpOrder = ["xformOp:translate"]
float physics:mass = 2
float3 physics:diagonalInertia = (0.1, 0.2, 0.3)

def Cube "Shape" (apiSchemas = ["PhysicsCollisionAPI"]) {
double size = 0.4
}

}
)"},
      {"PhysxMaterialAPI", "", R"(def PhysicsScene "S" {
vector3f physics:gravityDirection = (0, 0, -1)
float physics:gravityMagnitude = 10
}
def Cube "Ground" (apiSchemas = ["PhysicsCollisionAPI", "MaterialBindingAPI"]) {
double size = 20
double3 xformOp:translate = (0, 0, -10)
uniform token[] xformOpOrder = ["xformOp:translate"]
rel material:binding:physics = </M2>
}
def Material "M2" (apiSchemas = ["PhysicsMaterialAPI", "PhysxMaterialAPI"]) {
float physics:staticFriction = 0.1
float physics:dynamicFriction = 0.1
float physxMaterial:compliantContactStiffness = 1000
float physxMaterial:compliantContactDamping = 200
}
def Material "M" (apiSchemas = ["PhysicsMaterialAPI", "PhysxMaterialAPI"]) {
float physics:staticFriction = 0.9
float physics:dynamicFriction = 0.9
float physics:restitution = 0.8
float physxMaterial:compliantContactStiffness = 2000
float physxMaterial:compliantContactDamping = 20

@
}
def Xform "B" (apiSchemas = ["PhysicsRigidBodyAPI", "PhysicsMassAPI"]) {
double3 xformOp:translate = (0, 0, 0.25)
uniform token[] xformOpOrder = ["xformOp:translate"]
float physics:mass = 2
float3 physics:diagonalInertia = (0.1, 0.2, 0.3)
vector3f physics:velocity = (2, 0, -1)
vector3f physics:angularVelocity = (0, 0, 900)
def Sphere "Shape" (apiSchemas = ["PhysicsCollisionAPI", "MaterialBindingAPI", "MjcCollisionAPI"]) {
double radius = 0.2
rel material:binding:physics = </M>
int mjc:condim = 6
}

}
)"},
      {"PhysxMaterialAPI", "", R"(def PhysicsScene "S" {
vector3f physics:gravityDirection = (0, 0, -1)
float physics:gravityMagnitude = 10
}
def Cube "Ground" (apiSchemas = ["PhysicsCollisionAPI", "MaterialBindingAPI"]) {
double size = 20
double3 xformOp:translate = (0, 0, -10)
uniform token[] xformOpOrder = ["xformOp:translate"]
rel material:binding:physics = </M2>
}
def Material "M2" (apiSchemas = ["PhysicsMaterialAPI"]) {
float physics:staticFriction = 0.1
float physics:dynamicFriction = 0.1

}
def Material "M" (apiSchemas = ["PhysicsMaterialAPI", "PhysxMaterialAPI"]) {
float physics:staticFriction = 0.9
float physics:dynamicFriction = 0.9
float physics:restitution = 0.8

@
}
def Xform "B" (apiSchemas = ["PhysicsRigidBodyAPI", "PhysicsMassAPI"]) {
double3 xformOp:translate = (0, 0, 0.25)
uniform token[] xformOpOrder = ["xformOp:translate"]
float physics:mass = 2
float3 physics:diagonalInertia = (0.1, 0.2, 0.3)
vector3f physics:velocity = (2, 0, -1)
vector3f physics:angularVelocity = (0, 0, 900)
def Sphere "Shape" (apiSchemas = ["PhysicsCollisionAPI", "MaterialBindingAPI", "MjcCollisionAPI"]) {
double radius = 0.2
rel material:binding:physics = </M>
int mjc:condim = 6
}

}
)"},
      {"NewtonMaterialAPI", "", R"(def PhysicsScene "S" {
vector3f physics:gravityDirection = (0, 0, -1)
float physics:gravityMagnitude = 10
}
def Cube "Ground" (apiSchemas = ["PhysicsCollisionAPI", "MaterialBindingAPI"]) {
double size = 20
double3 xformOp:translate = (0, 0, -10)
uniform token[] xformOpOrder = ["xformOp:translate"]
rel material:binding:physics = </M2>
}
def Material "M2" (apiSchemas = ["PhysicsMaterialAPI"]) {
float physics:staticFriction = 0.1
float physics:dynamicFriction = 0.1

}
def Material "M" (apiSchemas = ["PhysicsMaterialAPI", "NewtonMaterialAPI"]) {
float physics:staticFriction = 0.9
float physics:dynamicFriction = 0.9
float physics:restitution = 0.8

@
}
def Xform "B" (apiSchemas = ["PhysicsRigidBodyAPI", "PhysicsMassAPI"]) {
double3 xformOp:translate = (0, 0, 0.25)
uniform token[] xformOpOrder = ["xformOp:translate"]
float physics:mass = 2
float3 physics:diagonalInertia = (0.1, 0.2, 0.3)
vector3f physics:velocity = (2, 0, -1)
vector3f physics:angularVelocity = (0, 0, 900)
def Sphere "Shape" (apiSchemas = ["PhysicsCollisionAPI", "MaterialBindingAPI", "MjcCollisionAPI"]) {
double radius = 0.2
rel material:binding:physics = </M>
int mjc:condim = 6
}

}
)"},
      {"MjcMaterialAPI", "", R"(def PhysicsScene "S" {
vector3f physics:gravityDirection = (0, 0, -1)
float physics:gravityMagnitude = 10
}
def Cube "Ground" (apiSchemas = ["PhysicsCollisionAPI", "MaterialBindingAPI"]) {
double size = 20
double3 xformOp:translate = (0, 0, -10)
uniform token[] xformOpOrder = ["xformOp:translate"]
rel material:binding:physics = </M2>
}
def Material "M2" (apiSchemas = ["PhysicsMaterialAPI"]) {
float physics:staticFriction = 0.1
float physics:dynamicFriction = 0.1

}
def Material "M" (apiSchemas = ["PhysicsMaterialAPI", "MjcMaterialAPI"]) {
float physics:staticFriction = 0.9
float physics:dynamicFriction = 0.9
float physics:restitution = 0.8

@
}
def Xform "B" (apiSchemas = ["PhysicsRigidBodyAPI", "PhysicsMassAPI"]) {
double3 xformOp:translate = (0, 0, 0.25)
uniform token[] xformOpOrder = ["xformOp:translate"]
float physics:mass = 2
float3 physics:diagonalInertia = (0.1, 0.2, 0.3)
vector3f physics:velocity = (2, 0, -1)
vector3f physics:angularVelocity = (0, 0, 900)
def Sphere "Shape" (apiSchemas = ["PhysicsCollisionAPI", "MaterialBindingAPI", "MjcCollisionAPI"]) {
double radius = 0.2
rel material:binding:physics = </M>
int mjc:condim = 6
}

}
)"},
      {"PhysxPhysicsGearJoint", "", R"(def PhysicsScene "S" {
vector3f physics:gravityDirection = (0, 0, -1)
float physics:gravityMagnitude = 10
}
def Xform "B" (apiSchemas = ["PhysicsRigidBodyAPI", "PhysicsMassAPI"]) {
double3 xformOp:translate = (0.5, 0, 1)
uniform token[] xformOpOrder = ["xformOp:translate"]
float physics:mass = 2
float3 physics:diagonalInertia = (0.1, 0.2, 0.3)

def Cube "Shape" (apiSchemas = ["PhysicsCollisionAPI"]) {
double size = 0.4
}

}
def Xform "C" (apiSchemas = ["PhysicsRigidBodyAPI", "PhysicsMassAPI"]) {
double3 xformOp:translate = (0.5, 0.3, 1)
uniform token[] xformOpOrder = ["xformOp:translate"]
float physics:mass = 2
float3 physics:diagonalInertia = (0.1, 0.2, 0.3)

def Cube "Shape" (apiSchemas = ["PhysicsCollisionAPI"]) {
double size = 0.4
}

}
def PhysicsRevoluteJoint "H0" (apiSchemas = []) {
rel physics:body1 = </B>
point3f physics:localPos0 = (0, 0, 1)
point3f physics:localPos1 = (-0.5, 0, 0)
uniform token physics:axis = "Y"

}
def PhysicsRevoluteJoint "H1" (apiSchemas = []) {
rel physics:body1 = </C>
point3f physics:localPos0 = (0, 0.3, 1)
point3f physics:localPos1 = (-0.5, 0, 0)
uniform token physics:axis = "Y"

}
def PhysxPhysicsGearJoint "Gear" {
rel physics:body0 = </B>
rel physics:body1 = </C>
rel physics:hinge0 = </H0>
rel physics:hinge1 = </H1>
float physics:gearRatio = -2
@
}
)"},
      {"PhysxPhysicsRackAndPinionJoint", "", R"(def PhysicsScene "S" {
vector3f physics:gravityDirection = (0, 0, -1)
float physics:gravityMagnitude = 10
}
def Xform "B" (apiSchemas = ["PhysicsRigidBodyAPI", "PhysicsMassAPI"]) {
double3 xformOp:translate = (0.5, 0, 1)
uniform token[] xformOpOrder = ["xformOp:translate"]
float physics:mass = 2
float3 physics:diagonalInertia = (0.1, 0.2, 0.3)

def Cube "Shape" (apiSchemas = ["PhysicsCollisionAPI"]) {
double size = 0.4
}

}
def Xform "C" (apiSchemas = ["PhysicsRigidBodyAPI", "PhysicsMassAPI"]) {
double3 xformOp:translate = (0.5, 0.3, 1)
uniform token[] xformOpOrder = ["xformOp:translate"]
float physics:mass = 2
float3 physics:diagonalInertia = (0.1, 0.2, 0.3)

def Cube "Shape" (apiSchemas = ["PhysicsCollisionAPI"]) {
double size = 0.4
}

}
def PhysicsRevoluteJoint "H0" (apiSchemas = []) {
rel physics:body1 = </B>
point3f physics:localPos0 = (0, 0, 1)
point3f physics:localPos1 = (-0.5, 0, 0)
uniform token physics:axis = "Y"

}
def PhysicsPrismaticJoint "H1" (apiSchemas = []) {
rel physics:body1 = </C>
point3f physics:localPos0 = (0.5, 0.3, 1)
uniform token physics:axis = "X"
}
def PhysxPhysicsRackAndPinionJoint "Rack" {
rel physics:body0 = </B>
rel physics:body1 = </C>
rel physics:hinge = </H0>
rel physics:prismatic = </H1>
float physics:ratio = 90
@
}
)"},
      {"PhysxPhysicsDistanceJointAPI", "", R"(def PhysicsScene "S" {
vector3f physics:gravityDirection = (0, 0, -1)
float physics:gravityMagnitude = 10
}
def Xform "B" (apiSchemas = ["PhysicsRigidBodyAPI", "PhysicsMassAPI"]) {
double3 xformOp:translate = (0, 0, 0)
uniform token[] xformOpOrder = ["xformOp:translate"]
float physics:mass = 2
float3 physics:diagonalInertia = (0.1, 0.2, 0.3)


}
def PhysicsDistanceJoint "J" (apiSchemas = ["PhysxPhysicsDistanceJointAPI"]) {
rel physics:body1 = </B>
point3f physics:localPos0 = (0, 0, 1)
float physics:maxDistance = 1
bool physxPhysicsDistanceJoint:springEnabled = 1
float physxPhysicsDistanceJoint:springStiffness = 50
float physxPhysicsDistanceJoint:springDamping = 2
@
}
)"},
      {"PhysxLimitAPI", "angular", R"(def PhysicsScene "S" {
vector3f physics:gravityDirection = (0, 0, -1)
float physics:gravityMagnitude = 10
}
def Xform "B" (apiSchemas = ["PhysicsRigidBodyAPI", "PhysicsMassAPI"]) {
double3 xformOp:translate = (0.5, 0, 1)
uniform token[] xformOpOrder = ["xformOp:translate"]
float physics:mass = 2
float3 physics:diagonalInertia = (0.1, 0.2, 0.3)


}
def PhysicsRevoluteJoint "J" (apiSchemas = ["PhysxLimitAPI:angular"]) {
rel physics:body1 = </B>
point3f physics:localPos0 = (0, 0, 1)
point3f physics:localPos1 = (-0.5, 0, 0)
uniform token physics:axis = "Y"
float physics:upperLimit = 5
float physxLimit:angular:stiffness = 20
@
}
)"},
      {"PhysxLimitAPI", "angular", R"(def PhysicsScene "S" {
vector3f physics:gravityDirection = (0, 0, -1)
float physics:gravityMagnitude = 10
}
def Xform "B" (apiSchemas = ["PhysicsRigidBodyAPI", "PhysicsMassAPI"]) {
double3 xformOp:translate = (0.5, 0, 1)
uniform token[] xformOpOrder = ["xformOp:translate"]
float physics:mass = 2
float3 physics:diagonalInertia = (0.1, 0.2, 0.3)


}
def PhysicsRevoluteJoint "J" (apiSchemas = ["PhysxLimitAPI:angular"]) {
rel physics:body1 = </B>
point3f physics:localPos0 = (0, 0, 1)
point3f physics:localPos1 = (-0.5, 0, 0)
uniform token physics:axis = "Y"
float physics:upperLimit = 5
float physxLimit:angular:restitution = 0.7
@
}
)"},
      {"PhysicsJointStateAPI", "angular", R"(def PhysicsScene "S" {
vector3f physics:gravityDirection = (0, 0, -1)
float physics:gravityMagnitude = 10
}
def Xform "B" (apiSchemas = ["PhysicsRigidBodyAPI", "PhysicsMassAPI"]) {
double3 xformOp:translate = (0.5, 0, 1)
uniform token[] xformOpOrder = ["xformOp:translate"]
float physics:mass = 2
float3 physics:diagonalInertia = (0.1, 0.2, 0.3)


}
def PhysicsRevoluteJoint "J" (apiSchemas = ["PhysicsJointStateAPI:angular"]) {
rel physics:body1 = </B>
point3f physics:localPos0 = (0, 0, 1)
point3f physics:localPos1 = (-0.5, 0, 0)
uniform token physics:axis = "Y"
@
}
)"},
      {"PhysxJointAPI", "", R"(def PhysicsScene "S" {
vector3f physics:gravityDirection = (0, 0, -1)
float physics:gravityMagnitude = 10
}
def Xform "B" (apiSchemas = ["PhysicsRigidBodyAPI", "PhysicsMassAPI"]) {
double3 xformOp:translate = (0.5, 0, 1)
uniform token[] xformOpOrder = ["xformOp:translate"]
float physics:mass = 2
float3 physics:diagonalInertia = (0.1, 0.2, 0.3)


}
def PhysicsRevoluteJoint "J" (apiSchemas = ["PhysxJointAPI"]) {
rel physics:body1 = </B>
point3f physics:localPos0 = (0, 0, 1)
point3f physics:localPos1 = (-0.5, 0, 0)
uniform token physics:axis = "Y"
@
}
)"},
      {"NewtonJointAPI", "", R"(def PhysicsScene "S" {
vector3f physics:gravityDirection = (0, 0, -1)
float physics:gravityMagnitude = 10
}
def Xform "B" (apiSchemas = ["PhysicsRigidBodyAPI", "PhysicsMassAPI"]) {
double3 xformOp:translate = (0.5, 0, 1)
uniform token[] xformOpOrder = ["xformOp:translate"]
float physics:mass = 2
float3 physics:diagonalInertia = (0.1, 0.2, 0.3)


}
def PhysicsRevoluteJoint "J" (apiSchemas = ["NewtonJointAPI"]) {
rel physics:body1 = </B>
point3f physics:localPos0 = (0, 0, 1)
point3f physics:localPos1 = (-0.5, 0, 0)
uniform token physics:axis = "Y"
@
}
)"},
      {"MjcJointAPI", "", R"(def PhysicsScene "S" {
vector3f physics:gravityDirection = (0, 0, -1)
float physics:gravityMagnitude = 10
}
def Xform "B" (apiSchemas = ["PhysicsRigidBodyAPI", "PhysicsMassAPI"]) {
double3 xformOp:translate = (0.5, 0, 1)
uniform token[] xformOpOrder = ["xformOp:translate"]
float physics:mass = 2
float3 physics:diagonalInertia = (0.1, 0.2, 0.3)


}
def PhysicsRevoluteJoint "J" (apiSchemas = ["MjcJointAPI"]) {
rel physics:body1 = </B>
point3f physics:localPos0 = (0, 0, 1)
point3f physics:localPos1 = (-0.5, 0, 0)
uniform token physics:axis = "Y"
float physics:upperLimit = 5
double mjc:frictionloss = 0.5
double mjc:stiffness = 3
@
}
)"},
      {"PhysxJointAxisAPI", "angular", R"(def PhysicsScene "S" {
vector3f physics:gravityDirection = (0, 0, -1)
float physics:gravityMagnitude = 10
}
def Xform "B" (apiSchemas = ["PhysicsRigidBodyAPI", "PhysicsMassAPI"]) {
double3 xformOp:translate = (0.5, 0, 1)
uniform token[] xformOpOrder = ["xformOp:translate"]
float physics:mass = 2
float3 physics:diagonalInertia = (0.1, 0.2, 0.3)


}
def PhysicsRevoluteJoint "J" (apiSchemas = ["PhysxJointAxisAPI:angular"]) {
rel physics:body1 = </B>
point3f physics:localPos0 = (0, 0, 1)
point3f physics:localPos1 = (-0.5, 0, 0)
uniform token physics:axis = "Y"
@
}
)"},
      {"PhysxDrivePerformanceEnvelopeAPI", "angular", R"(def PhysicsScene "S" {
vector3f physics:gravityDirection = (0, 0, -1)
float physics:gravityMagnitude = 10
}
def Xform "B" (apiSchemas = ["PhysicsRigidBodyAPI", "PhysicsMassAPI"]) {
double3 xformOp:translate = (0.5, 0, 1)
uniform token[] xformOpOrder = ["xformOp:translate"]
float physics:mass = 2
float3 physics:diagonalInertia = (0.1, 0.2, 0.3)


}
def PhysicsRevoluteJoint "J" (apiSchemas = ["PhysicsDriveAPI:angular", "PhysxDrivePerformanceEnvelopeAPI:angular"]) {
rel physics:body1 = </B>
point3f physics:localPos0 = (0, 0, 1)
point3f physics:localPos1 = (-0.5, 0, 0)
uniform token physics:axis = "Y"
float drive:angular:physics:damping = 100
float drive:angular:physics:targetVelocity = 90
float drive:angular:physics:maxForce = 30
float physxDrivePerformanceEnvelope:angular:maxActuatorVelocity = 50
@
}
)"},
      {"PhysxArticulationAPI", "", R"(def PhysicsScene "S" {
vector3f physics:gravityDirection = (0, 0, -1)
float physics:gravityMagnitude = 10
}
def Xform "R" (apiSchemas = ["PhysicsArticulationRootAPI", "PhysxArticulationAPI"]) {
bool physxArticulation:enabledSelfCollisions = 0
@
def PhysicsFixedJoint "Fix" {
rel physics:body1 = </R/A>
}
def Xform "A" (apiSchemas = ["PhysicsRigidBodyAPI", "PhysicsMassAPI"]) {
double3 xformOp:translate = (0, 0, 1)
uniform token[] xformOpOrder = ["xformOp:translate"]
float physics:mass = 2
float3 physics:diagonalInertia = (0.1, 0.2, 0.3)

def Cube "Shape" (apiSchemas = ["PhysicsCollisionAPI"]) {
double size = 0.4
}

}
def Xform "B" (apiSchemas = ["PhysicsRigidBodyAPI", "PhysicsMassAPI"]) {
double3 xformOp:translate = (0.5, 0, 1)
uniform token[] xformOpOrder = ["xformOp:translate"]
float physics:mass = 2
float3 physics:diagonalInertia = (0.1, 0.2, 0.3)

def Cube "Shape" (apiSchemas = ["PhysicsCollisionAPI"]) {
double size = 0.4
}

}
def Xform "C" (apiSchemas = ["PhysicsRigidBodyAPI", "PhysicsMassAPI"]) {
double3 xformOp:translate = (0.3, 0.3, 1.3)
uniform token[] xformOpOrder = ["xformOp:translate"]
float physics:mass = 2
float3 physics:diagonalInertia = (0.1, 0.2, 0.3)

def Cube "Shape" (apiSchemas = ["PhysicsCollisionAPI"]) {
double size = 0.4
}

}
def PhysicsRevoluteJoint "J0" (apiSchemas = []) {
rel physics:body0 = </R/A>
rel physics:body1 = </R/B>
point3f physics:localPos1 = (-0.5, 0, 0)
uniform token physics:axis = "Y"

}
def PhysicsRevoluteJoint "J1" (apiSchemas = []) {
rel physics:body0 = </R/B>
rel physics:body1 = </R/C>
point3f physics:localPos1 = (0.2, -0.3, -0.3)
uniform token physics:axis = "Y"

}
}
)"},
      {"NewtonArticulationRootAPI", "", R"(def PhysicsScene "S" {
vector3f physics:gravityDirection = (0, 0, -1)
float physics:gravityMagnitude = 10
}
def Xform "R" (apiSchemas = ["PhysicsArticulationRootAPI", "NewtonArticulationRootAPI"]) {
@
def PhysicsFixedJoint "Fix" {
rel physics:body1 = </R/A>
}
def Xform "A" (apiSchemas = ["PhysicsRigidBodyAPI", "PhysicsMassAPI"]) {
double3 xformOp:translate = (0, 0, 1)
uniform token[] xformOpOrder = ["xformOp:translate"]
float physics:mass = 2
float3 physics:diagonalInertia = (0.1, 0.2, 0.3)

def Cube "Shape" (apiSchemas = ["PhysicsCollisionAPI"]) {
double size = 0.4
}

}
def Xform "B" (apiSchemas = ["PhysicsRigidBodyAPI", "PhysicsMassAPI"]) {
double3 xformOp:translate = (0.5, 0, 1)
uniform token[] xformOpOrder = ["xformOp:translate"]
float physics:mass = 2
float3 physics:diagonalInertia = (0.1, 0.2, 0.3)

def Cube "Shape" (apiSchemas = ["PhysicsCollisionAPI"]) {
double size = 0.4
}

}
def Xform "C" (apiSchemas = ["PhysicsRigidBodyAPI", "PhysicsMassAPI"]) {
double3 xformOp:translate = (0.3, 0.3, 1.3)
uniform token[] xformOpOrder = ["xformOp:translate"]
float physics:mass = 2
float3 physics:diagonalInertia = (0.1, 0.2, 0.3)

def Cube "Shape" (apiSchemas = ["PhysicsCollisionAPI"]) {
double size = 0.4
}

}
def PhysicsRevoluteJoint "J0" (apiSchemas = []) {
rel physics:body0 = </R/A>
rel physics:body1 = </R/B>
point3f physics:localPos1 = (-0.5, 0, 0)
uniform token physics:axis = "Y"

}
def PhysicsRevoluteJoint "J1" (apiSchemas = []) {
rel physics:body0 = </R/B>
rel physics:body1 = </R/C>
point3f physics:localPos1 = (0.2, -0.3, -0.3)
uniform token physics:axis = "Y"

}
}
)"},
      {"PhysxForceAPI", "", R"(def PhysicsScene "S" {
vector3f physics:gravityDirection = (0, 0, -1)
float physics:gravityMagnitude = 10
}
def Xform "B" (apiSchemas = ["PhysicsRigidBodyAPI", "PhysicsMassAPI", "PhysxForceAPI"]) {
double3 xformOp:translate = (0, 0, 1)
uniform token[] xformOpOrder = ["xformOp:translate", "xformOp:orient"]
float physics:mass = 2
float3 physics:diagonalInertia = (0.1, 0.2, 0.3)
quatf xformOp:orient = (0.9238795, 0, 0, 0.3826834)
vector3f physxForce:force = (1, 2, 3)
vector3f physxForce:torque = (1, 0, 0)
@

}
)"},
      {"PhysxTendonAxisRootAPI", "t", R"(def PhysicsScene "S" {
vector3f physics:gravityDirection = (0, 0, -1)
float physics:gravityMagnitude = 10
}
def Xform "R" (apiSchemas = ["PhysicsArticulationRootAPI", "PhysxArticulationAPI"]) {

def PhysicsFixedJoint "Fix" {
rel physics:body1 = </R/A>
}
def Xform "A" (apiSchemas = ["PhysicsRigidBodyAPI", "PhysicsMassAPI"]) {
double3 xformOp:translate = (0, 0, 1)
uniform token[] xformOpOrder = ["xformOp:translate"]
float physics:mass = 2
float3 physics:diagonalInertia = (0.1, 0.2, 0.3)

def Cube "Shape" (apiSchemas = ["PhysicsCollisionAPI"]) {
double size = 0.4
}

}
def Xform "B" (apiSchemas = ["PhysicsRigidBodyAPI", "PhysicsMassAPI"]) {
double3 xformOp:translate = (0.5, 0, 1)
uniform token[] xformOpOrder = ["xformOp:translate"]
float physics:mass = 2
float3 physics:diagonalInertia = (0.1, 0.2, 0.3)

def Cube "Shape" (apiSchemas = ["PhysicsCollisionAPI"]) {
double size = 0.4
}

}
def Xform "C" (apiSchemas = ["PhysicsRigidBodyAPI", "PhysicsMassAPI"]) {
double3 xformOp:translate = (0.3, 0.3, 1.3)
uniform token[] xformOpOrder = ["xformOp:translate"]
float physics:mass = 2
float3 physics:diagonalInertia = (0.1, 0.2, 0.3)

def Cube "Shape" (apiSchemas = ["PhysicsCollisionAPI"]) {
double size = 0.4
}

}
def PhysicsRevoluteJoint "J0" (apiSchemas = ["PhysxTendonAxisRootAPI:t"]) {
rel physics:body0 = </R/A>
rel physics:body1 = </R/B>
point3f physics:localPos1 = (-0.5, 0, 0)
uniform token physics:axis = "Y"
float physxTendon:t:stiffness = 2
float physxTendon:t:restLength = 10
float physxTendon:t:limitStiffness = 3
float physxTendon:t:upperLimit = 2
float physxTendon:t:lowerLimit = -2
@
}
def PhysicsRevoluteJoint "J1" (apiSchemas = ["PhysxTendonAxisAPI:t"]) {
rel physics:body0 = </R/B>
rel physics:body1 = </R/C>
point3f physics:localPos1 = (0.2, -0.3, -0.3)
uniform token physics:axis = "Y"
float[] physxTendon:t:gearing = [2]
}
}
)"},
      {"PhysxTendonAxisAPI", "t", R"(def PhysicsScene "S" {
vector3f physics:gravityDirection = (0, 0, -1)
float physics:gravityMagnitude = 10
}
def Xform "R" (apiSchemas = ["PhysicsArticulationRootAPI", "PhysxArticulationAPI"]) {

def PhysicsFixedJoint "Fix" {
rel physics:body1 = </R/A>
}
def Xform "A" (apiSchemas = ["PhysicsRigidBodyAPI", "PhysicsMassAPI"]) {
double3 xformOp:translate = (0, 0, 1)
uniform token[] xformOpOrder = ["xformOp:translate"]
float physics:mass = 2
float3 physics:diagonalInertia = (0.1, 0.2, 0.3)

def Cube "Shape" (apiSchemas = ["PhysicsCollisionAPI"]) {
double size = 0.4
}

}
def Xform "B" (apiSchemas = ["PhysicsRigidBodyAPI", "PhysicsMassAPI"]) {
double3 xformOp:translate = (0.5, 0, 1)
uniform token[] xformOpOrder = ["xformOp:translate"]
float physics:mass = 2
float3 physics:diagonalInertia = (0.1, 0.2, 0.3)

def Cube "Shape" (apiSchemas = ["PhysicsCollisionAPI"]) {
double size = 0.4
}

}
def Xform "C" (apiSchemas = ["PhysicsRigidBodyAPI", "PhysicsMassAPI"]) {
double3 xformOp:translate = (0.3, 0.3, 1.3)
uniform token[] xformOpOrder = ["xformOp:translate"]
float physics:mass = 2
float3 physics:diagonalInertia = (0.1, 0.2, 0.3)

def Cube "Shape" (apiSchemas = ["PhysicsCollisionAPI"]) {
double size = 0.4
}

}
def PhysicsRevoluteJoint "J0" (apiSchemas = ["PhysxTendonAxisRootAPI:t"]) {
rel physics:body0 = </R/A>
rel physics:body1 = </R/B>
point3f physics:localPos1 = (-0.5, 0, 0)
uniform token physics:axis = "Y"
float physxTendon:t:stiffness = 2
float physxTendon:t:restLength = 10
float physxTendon:t:limitStiffness = 3
float physxTendon:t:upperLimit = 2
float physxTendon:t:lowerLimit = -2

}
def PhysicsRevoluteJoint "J1" (apiSchemas = ["PhysxTendonAxisAPI:t"]) {
rel physics:body0 = </R/B>
rel physics:body1 = </R/C>
point3f physics:localPos1 = (0.2, -0.3, -0.3)
uniform token physics:axis = "Y"
float[] physxTendon:t:gearing = [2]
@
}
}
)"},
      {"PhysxTendonAttachmentRootAPI", "r", R"(def PhysicsScene "S" {
vector3f physics:gravityDirection = (0, 0, -1)
float physics:gravityMagnitude = 10
}
def Xform "A" (apiSchemas = ["PhysicsRigidBodyAPI", "PhysicsMassAPI", "PhysxTendonAttachmentRootAPI:r"]) {
double3 xformOp:translate = (0, 0, 2)
uniform token[] xformOpOrder = ["xformOp:translate"]
float physics:mass = 2
float3 physics:diagonalInertia = (0.1, 0.2, 0.3)
bool physics:kinematicEnabled = 1
float physxTendon:r:stiffness = 50
float physxTendon:r:limitStiffness = 50
point3f physxTendon:r:localPos = (0, 0, 0.1)
@

}
def Xform "B" (apiSchemas = ["PhysicsRigidBodyAPI", "PhysicsMassAPI", "PhysxTendonAttachmentAPI:m"]) {
double3 xformOp:translate = (0.5, 0, 1.5)
uniform token[] xformOpOrder = ["xformOp:translate"]
float physics:mass = 2
float3 physics:diagonalInertia = (0.1, 0.2, 0.3)
uniform token physxTendon:m:parentAttachment = "r"
rel physxTendon:m:parentLink = </A>
float physxTendon:m:gearing = 2


}
def Xform "C" (apiSchemas = ["PhysicsRigidBodyAPI", "PhysicsMassAPI", "PhysxTendonAttachmentLeafAPI:l"]) {
double3 xformOp:translate = (0, 0.3, 1)
uniform token[] xformOpOrder = ["xformOp:translate"]
float physics:mass = 2
float3 physics:diagonalInertia = (0.1, 0.2, 0.3)
uniform token physxTendon:l:parentAttachment = "m"
rel physxTendon:l:parentLink = </B>
float physxTendon:l:restLength = 1
float physxTendon:l:upperLimit = 1.2


}
)"},
      {"PhysxTendonAttachmentAPI", "m", R"(def PhysicsScene "S" {
vector3f physics:gravityDirection = (0, 0, -1)
float physics:gravityMagnitude = 10
}
def Xform "A" (apiSchemas = ["PhysicsRigidBodyAPI", "PhysicsMassAPI", "PhysxTendonAttachmentRootAPI:r"]) {
double3 xformOp:translate = (0, 0, 2)
uniform token[] xformOpOrder = ["xformOp:translate"]
float physics:mass = 2
float3 physics:diagonalInertia = (0.1, 0.2, 0.3)
bool physics:kinematicEnabled = 1
float physxTendon:r:stiffness = 50
float physxTendon:r:limitStiffness = 50
point3f physxTendon:r:localPos = (0, 0, 0.1)


}
def Xform "B" (apiSchemas = ["PhysicsRigidBodyAPI", "PhysicsMassAPI", "PhysxTendonAttachmentAPI:m"]) {
double3 xformOp:translate = (0.5, 0, 1.5)
uniform token[] xformOpOrder = ["xformOp:translate"]
float physics:mass = 2
float3 physics:diagonalInertia = (0.1, 0.2, 0.3)
uniform token physxTendon:m:parentAttachment = "r"
rel physxTendon:m:parentLink = </A>
float physxTendon:m:gearing = 2
@

}
def Xform "C" (apiSchemas = ["PhysicsRigidBodyAPI", "PhysicsMassAPI", "PhysxTendonAttachmentLeafAPI:l"]) {
double3 xformOp:translate = (0, 0.3, 1)
uniform token[] xformOpOrder = ["xformOp:translate"]
float physics:mass = 2
float3 physics:diagonalInertia = (0.1, 0.2, 0.3)
uniform token physxTendon:l:parentAttachment = "m"
rel physxTendon:l:parentLink = </B>
float physxTendon:l:restLength = 1
float physxTendon:l:upperLimit = 1.2


}
)"},
      {"PhysxTendonAttachmentLeafAPI", "l", R"(def PhysicsScene "S" {
vector3f physics:gravityDirection = (0, 0, -1)
float physics:gravityMagnitude = 10
}
def Xform "A" (apiSchemas = ["PhysicsRigidBodyAPI", "PhysicsMassAPI", "PhysxTendonAttachmentRootAPI:r"]) {
double3 xformOp:translate = (0, 0, 2)
uniform token[] xformOpOrder = ["xformOp:translate"]
float physics:mass = 2
float3 physics:diagonalInertia = (0.1, 0.2, 0.3)
bool physics:kinematicEnabled = 1
float physxTendon:r:stiffness = 50
float physxTendon:r:limitStiffness = 50
point3f physxTendon:r:localPos = (0, 0, 0.1)


}
def Xform "B" (apiSchemas = ["PhysicsRigidBodyAPI", "PhysicsMassAPI", "PhysxTendonAttachmentAPI:m"]) {
double3 xformOp:translate = (0.5, 0, 1.5)
uniform token[] xformOpOrder = ["xformOp:translate"]
float physics:mass = 2
float3 physics:diagonalInertia = (0.1, 0.2, 0.3)
uniform token physxTendon:m:parentAttachment = "r"
rel physxTendon:m:parentLink = </A>
float physxTendon:m:gearing = 2


}
def Xform "C" (apiSchemas = ["PhysicsRigidBodyAPI", "PhysicsMassAPI", "PhysxTendonAttachmentLeafAPI:l"]) {
double3 xformOp:translate = (0, 0.3, 1)
uniform token[] xformOpOrder = ["xformOp:translate"]
float physics:mass = 2
float3 physics:diagonalInertia = (0.1, 0.2, 0.3)
uniform token physxTendon:l:parentAttachment = "m"
rel physxTendon:l:parentLink = </B>
float physxTendon:l:restLength = 1
float physxTendon:l:upperLimit = 1.2
@

}
)"},
      {"PhysxMimicJointAPI", "rotY", R"(def PhysicsScene "S" {
vector3f physics:gravityDirection = (0, 0, -1)
float physics:gravityMagnitude = 10
}
def Xform "B" (apiSchemas = ["PhysicsRigidBodyAPI", "PhysicsMassAPI"]) {
double3 xformOp:translate = (0.5, 0, 1)
uniform token[] xformOpOrder = ["xformOp:translate"]
float physics:mass = 2
float3 physics:diagonalInertia = (0.1, 0.2, 0.3)


}
def Xform "C" (apiSchemas = ["PhysicsRigidBodyAPI", "PhysicsMassAPI"]) {
double3 xformOp:translate = (0.5, 1, 1)
uniform token[] xformOpOrder = ["xformOp:translate"]
float physics:mass = 2
float3 physics:diagonalInertia = (0.1, 0.2, 0.3)


}
def PhysicsRevoluteJoint "H0" (apiSchemas = []) {
rel physics:body1 = </B>
point3f physics:localPos0 = (0, 0, 1)
point3f physics:localPos1 = (-0.5, 0, 0)
uniform token physics:axis = "Y"

}
def PhysicsRevoluteJoint "H1" (apiSchemas = ["PhysxMimicJointAPI:rotY"]) {
rel physics:body1 = </C>
point3f physics:localPos0 = (0, 1, 1)
point3f physics:localPos1 = (-0.5, 0, 0)
uniform token physics:axis = "Y"
rel physxMimicJoint:rotY:referenceJoint = </H0>
uniform token physxMimicJoint:rotY:referenceJointAxis = "rotY"
float physxMimicJoint:rotY:gearing = 2
float physxMimicJoint:rotY:naturalFrequency = 20
float physxMimicJoint:rotY:dampingRatio = 0.5
@
}
)"},
      {"PhysxMimicJointAPI", "rotY", R"(def PhysicsScene "S" {
vector3f physics:gravityDirection = (0, 0, -1)
float physics:gravityMagnitude = 10
}
def Xform "B" (apiSchemas = ["PhysicsRigidBodyAPI", "PhysicsMassAPI"]) {
double3 xformOp:translate = (0.5, 0, 1)
uniform token[] xformOpOrder = ["xformOp:translate"]
float physics:mass = 2
float3 physics:diagonalInertia = (0.1, 0.2, 0.3)


}
def Xform "C" (apiSchemas = ["PhysicsRigidBodyAPI", "PhysicsMassAPI"]) {
double3 xformOp:translate = (0.5, 1, 1)
uniform token[] xformOpOrder = ["xformOp:translate"]
float physics:mass = 2
float3 physics:diagonalInertia = (0.1, 0.2, 0.3)


}
def PhysicsJoint "H0" (apiSchemas = ["PhysicsLimitAPI:transX", "PhysicsLimitAPI:transY", "PhysicsLimitAPI:transZ"]) {
rel physics:body1 = </B>
point3f physics:localPos0 = (0, 0, 1)
point3f physics:localPos1 = (-0.5, 0, 0)
float limit:transX:physics:low = 1
float limit:transX:physics:high = -1
float limit:transY:physics:low = 1
float limit:transY:physics:high = -1
float limit:transZ:physics:low = 1
float limit:transZ:physics:high = -1
}
def PhysicsRevoluteJoint "H1" (apiSchemas = ["PhysxMimicJointAPI:rotY"]) {
rel physics:body1 = </C>
point3f physics:localPos0 = (0, 1, 1)
point3f physics:localPos1 = (-0.5, 0, 0)
uniform token physics:axis = "Y"
rel physxMimicJoint:rotY:referenceJoint = </H0>
uniform token physxMimicJoint:rotY:referenceJointAxis = "rotY"
@
}
)"},
      {"NewtonMimicAPI", "", R"(def PhysicsScene "S" {
vector3f physics:gravityDirection = (0, 0, -1)
float physics:gravityMagnitude = 10
}
def Xform "B" (apiSchemas = ["PhysicsRigidBodyAPI", "PhysicsMassAPI"]) {
double3 xformOp:translate = (0.5, 0, 1)
uniform token[] xformOpOrder = ["xformOp:translate"]
float physics:mass = 2
float3 physics:diagonalInertia = (0.1, 0.2, 0.3)


}
def Xform "C" (apiSchemas = ["PhysicsRigidBodyAPI", "PhysicsMassAPI"]) {
double3 xformOp:translate = (0.5, 1, 1)
uniform token[] xformOpOrder = ["xformOp:translate"]
float physics:mass = 2
float3 physics:diagonalInertia = (0.1, 0.2, 0.3)


}
def PhysicsRevoluteJoint "H0" (apiSchemas = []) {
rel physics:body1 = </B>
point3f physics:localPos0 = (0, 0, 1)
point3f physics:localPos1 = (-0.5, 0, 0)
uniform token physics:axis = "Y"

}
def PhysicsRevoluteJoint "H1" (apiSchemas = ["NewtonMimicAPI"]) {
rel physics:body1 = </C>
point3f physics:localPos0 = (0, 1, 1)
point3f physics:localPos1 = (-0.5, 0, 0)
uniform token physics:axis = "Y"
rel newton:mimicJoint = </H0>
float newton:mimicCoef1 = 2
@
}
)"},
      {"MjcEqualityJointAPI", "", R"(def PhysicsScene "S" {
vector3f physics:gravityDirection = (0, 0, -1)
float physics:gravityMagnitude = 10
}
def Xform "B" (apiSchemas = ["PhysicsRigidBodyAPI", "PhysicsMassAPI"]) {
double3 xformOp:translate = (0.5, 0, 1)
uniform token[] xformOpOrder = ["xformOp:translate"]
float physics:mass = 2
float3 physics:diagonalInertia = (0.1, 0.2, 0.3)


}
def Xform "C" (apiSchemas = ["PhysicsRigidBodyAPI", "PhysicsMassAPI"]) {
double3 xformOp:translate = (0.5, 1, 1)
uniform token[] xformOpOrder = ["xformOp:translate"]
float physics:mass = 2
float3 physics:diagonalInertia = (0.1, 0.2, 0.3)


}
def PhysicsRevoluteJoint "H0" (apiSchemas = []) {
rel physics:body1 = </B>
point3f physics:localPos0 = (0, 0, 1)
point3f physics:localPos1 = (-0.5, 0, 0)
uniform token physics:axis = "Y"

}
def PhysicsRevoluteJoint "H1" (apiSchemas = ["MjcEqualityJointAPI"]) {
rel physics:body1 = </C>
point3f physics:localPos0 = (0, 1, 1)
point3f physics:localPos1 = (-0.5, 0, 0)
uniform token physics:axis = "Y"
rel newton:mimicJoint = </H0>
@
}
)"},
      {"MjcEqualityJointAPI", "", R"(def PhysicsScene "S" {
vector3f physics:gravityDirection = (0, 0, -1)
float physics:gravityMagnitude = 10
}
def Xform "B" (apiSchemas = ["PhysicsRigidBodyAPI", "PhysicsMassAPI"]) {
double3 xformOp:translate = (0.5, 0, 1)
uniform token[] xformOpOrder = ["xformOp:translate"]
float physics:mass = 2
float3 physics:diagonalInertia = (0.1, 0.2, 0.3)


}
def Xform "C" (apiSchemas = ["PhysicsRigidBodyAPI", "PhysicsMassAPI"]) {
double3 xformOp:translate = (0.5, 1, 1)
uniform token[] xformOpOrder = ["xformOp:translate"]
float physics:mass = 2
float3 physics:diagonalInertia = (0.1, 0.2, 0.3)


}
def PhysicsRevoluteJoint "H0" (apiSchemas = []) {
rel physics:body1 = </B>
point3f physics:localPos0 = (0, 0, 1)
point3f physics:localPos1 = (-0.5, 0, 0)
uniform token physics:axis = "Y"

}
def PhysicsRevoluteJoint "H1" (apiSchemas = ["MjcEqualityJointAPI"]) {
rel physics:body1 = </C>
point3f physics:localPos0 = (0, 1, 1)
point3f physics:localPos1 = (-0.5, 0, 0)
uniform token physics:axis = "Y"
rel mjc:target = </H0>
@
}
)"},
      {"NewtonMassAPI", "", R"(def PhysicsScene "S" {
vector3f physics:gravityDirection = (0, 0, -1)
float physics:gravityMagnitude = 10
}
def Xform "B" (apiSchemas = ["PhysicsRigidBodyAPI", "PhysicsMassAPI", "NewtonMassAPI"]) {
double3 xformOp:translate = (0, 0, 1)
uniform token[] xformOpOrder = ["xformOp:translate"]
float physics:mass = 2
float3 physics:diagonalInertia = (0.1, 0.2, 0.3)
@

}
)"},
      {"MjcTendon", "", R"(def PhysicsScene "S" {
vector3f physics:gravityDirection = (0, 0, -1)
float physics:gravityMagnitude = 10
}
def Xform "B" (apiSchemas = ["PhysicsRigidBodyAPI", "PhysicsMassAPI"]) {
double3 xformOp:translate = (0.5, 0, 1)
uniform token[] xformOpOrder = ["xformOp:translate"]
float physics:mass = 2
float3 physics:diagonalInertia = (0.1, 0.2, 0.3)

def Xform "P" (apiSchemas = ["MjcSiteAPI"]) {
}

}
def Xform "C" (apiSchemas = ["PhysicsRigidBodyAPI", "PhysicsMassAPI"]) {
double3 xformOp:translate = (0.5, 1, 1)
uniform token[] xformOpOrder = ["xformOp:translate"]
float physics:mass = 2
float3 physics:diagonalInertia = (0.1, 0.2, 0.3)

def Xform "Q" (apiSchemas = ["MjcSiteAPI"]) {
}

}
def PhysicsRevoluteJoint "H0" (apiSchemas = []) {
rel physics:body1 = </B>
point3f physics:localPos0 = (0, 0, 1)
point3f physics:localPos1 = (-0.5, 0, 0)
uniform token physics:axis = "Y"

}
def PhysicsRevoluteJoint "H1" (apiSchemas = []) {
rel physics:body1 = </C>
point3f physics:localPos0 = (0, 1, 1)
point3f physics:localPos1 = (-0.5, 0, 0)
uniform token physics:axis = "Y"

}
def MjcTendon "T" {
uniform token mjc:type = "fixed"
rel mjc:path = [</H0>, </H1>]
uniform double[] mjc:path:coef = [1, 2]
@
double mjc:stiffness = 5
double mjc:frictionloss = 0.1
double mjc:range:min = -0.1
double mjc:range:max = 0.2
}
)"},
      {"MjcTendon", "", R"(def PhysicsScene "S" {
vector3f physics:gravityDirection = (0, 0, -1)
float physics:gravityMagnitude = 10
}
def Xform "B" (apiSchemas = ["PhysicsRigidBodyAPI", "PhysicsMassAPI"]) {
double3 xformOp:translate = (0.5, 0, 1)
uniform token[] xformOpOrder = ["xformOp:translate"]
float physics:mass = 2
float3 physics:diagonalInertia = (0.1, 0.2, 0.3)

def Xform "P" (apiSchemas = ["MjcSiteAPI"]) {
}

}
def Xform "C" (apiSchemas = ["PhysicsRigidBodyAPI", "PhysicsMassAPI"]) {
double3 xformOp:translate = (0.5, 1, 1)
uniform token[] xformOpOrder = ["xformOp:translate"]
float physics:mass = 2
float3 physics:diagonalInertia = (0.1, 0.2, 0.3)

def Xform "Q" (apiSchemas = ["MjcSiteAPI"]) {
}

}
def PhysicsRevoluteJoint "H0" (apiSchemas = []) {
rel physics:body1 = </B>
point3f physics:localPos0 = (0, 0, 1)
point3f physics:localPos1 = (-0.5, 0, 0)
uniform token physics:axis = "Y"

}
def PhysicsRevoluteJoint "H1" (apiSchemas = []) {
rel physics:body1 = </C>
point3f physics:localPos0 = (0, 1, 1)
point3f physics:localPos1 = (-0.5, 0, 0)
uniform token physics:axis = "Y"

}
def Sphere "W" {
double radius = 0.05
double3 xformOp:translate = (0.5, 0.5, 1)
uniform token[] xformOpOrder = ["xformOp:translate"]
}
def Xform "X" (apiSchemas = ["MjcSiteAPI"]) {
double3 xformOp:translate = (0.5, 0.5, 2)
uniform token[] xformOpOrder = ["xformOp:translate"]
}
def MjcTendon "T" {
uniform token mjc:type = "spatial"
rel mjc:path = [</B/P>, </W>, </C/Q>]
int[] mjc:path:indices = [0, 1, 2, 0, 2]
int[] mjc:path:segments = [0, 0, 0, 1, 1]
double[] mjc:path:divisors = [1, 2]
rel mjc:sideSites = </X>
int[] mjc:sideSites:indices = [-1, 0, -1, -1, -1]
double mjc:stiffness = 20
double[] mjc:springlength = [0.2]
@
}
)"},
      {"MjcActuator", "", R"(def PhysicsScene "S" {
vector3f physics:gravityDirection = (0, 0, -1)
float physics:gravityMagnitude = 10
}
def Xform "B" (apiSchemas = ["PhysicsRigidBodyAPI", "PhysicsMassAPI"]) {
double3 xformOp:translate = (0.5, 0, 1)
uniform token[] xformOpOrder = ["xformOp:translate"]
float physics:mass = 2
float3 physics:diagonalInertia = (0.1, 0.2, 0.3)

def Xform "P" (apiSchemas = ["MjcSiteAPI"]) {
}

}
def Xform "C" (apiSchemas = ["PhysicsRigidBodyAPI", "PhysicsMassAPI"]) {
double3 xformOp:translate = (0.5, 1, 1)
uniform token[] xformOpOrder = ["xformOp:translate"]
float physics:mass = 2
float3 physics:diagonalInertia = (0.1, 0.2, 0.3)

def Xform "Q" (apiSchemas = ["MjcSiteAPI"]) {
}

}
def PhysicsRevoluteJoint "H0" (apiSchemas = []) {
rel physics:body1 = </B>
point3f physics:localPos0 = (0, 0, 1)
point3f physics:localPos1 = (-0.5, 0, 0)
uniform token physics:axis = "Y"

}
def PhysicsRevoluteJoint "H1" (apiSchemas = []) {
rel physics:body1 = </C>
point3f physics:localPos0 = (0, 1, 1)
point3f physics:localPos1 = (-0.5, 0, 0)
uniform token physics:axis = "Y"

}
def MjcActuator "Act" {
rel mjc:target = </H0>
uniform token mjc:gainType = "fixed"
uniform token mjc:biasType = "affine"
uniform double[] mjc:biasPrm = [1, -20, -2]
@
}
)"},
      {"MjcActuator", "", R"(def PhysicsScene "S" {
vector3f physics:gravityDirection = (0, 0, -1)
float physics:gravityMagnitude = 10
}
def Xform "B" (apiSchemas = ["PhysicsRigidBodyAPI", "PhysicsMassAPI"]) {
double3 xformOp:translate = (0.5, 0, 1)
uniform token[] xformOpOrder = ["xformOp:translate"]
float physics:mass = 2
float3 physics:diagonalInertia = (0.1, 0.2, 0.3)

def Xform "P" (apiSchemas = ["MjcSiteAPI"]) {
}

}
def Xform "C" (apiSchemas = ["PhysicsRigidBodyAPI", "PhysicsMassAPI"]) {
double3 xformOp:translate = (0.5, 1, 1)
uniform token[] xformOpOrder = ["xformOp:translate"]
float physics:mass = 2
float3 physics:diagonalInertia = (0.1, 0.2, 0.3)

def Xform "Q" (apiSchemas = ["MjcSiteAPI"]) {
}

}
def PhysicsRevoluteJoint "H0" (apiSchemas = []) {
rel physics:body1 = </B>
point3f physics:localPos0 = (0, 0, 1)
point3f physics:localPos1 = (-0.5, 0, 0)
uniform token physics:axis = "Y"

}
def PhysicsRevoluteJoint "H1" (apiSchemas = []) {
rel physics:body1 = </C>
point3f physics:localPos0 = (0, 1, 1)
point3f physics:localPos1 = (-0.5, 0, 0)
uniform token physics:axis = "Y"

}
def MjcActuator "Act" {
rel mjc:target = </B/P>
rel mjc:refSite = </C/Q>
uniform double[] mjc:gear = [0, 0, 3, 0, 0, 0]
uniform double[] mjc:biasPrm = [1, 0, 0]
uniform token mjc:biasType = "affine"
uniform token mjc:dynType = "integrator"
@
}
)"},
      {"MjcActuator", "", R"(def PhysicsScene "S" {
vector3f physics:gravityDirection = (0, 0, -1)
float physics:gravityMagnitude = 10
}
def Xform "B" (apiSchemas = ["PhysicsRigidBodyAPI", "PhysicsMassAPI"]) {
double3 xformOp:translate = (0.5, 0, 1)
uniform token[] xformOpOrder = ["xformOp:translate"]
float physics:mass = 2
float3 physics:diagonalInertia = (0.1, 0.2, 0.3)

def Xform "P" (apiSchemas = ["MjcSiteAPI"]) {
}

}
def Xform "C" (apiSchemas = ["PhysicsRigidBodyAPI", "PhysicsMassAPI"]) {
double3 xformOp:translate = (0.5, 1, 1)
uniform token[] xformOpOrder = ["xformOp:translate"]
float physics:mass = 2
float3 physics:diagonalInertia = (0.1, 0.2, 0.3)

def Xform "Q" (apiSchemas = ["MjcSiteAPI"]) {
}

}
def PhysicsRevoluteJoint "H0" (apiSchemas = []) {
rel physics:body1 = </B>
point3f physics:localPos0 = (0, 0, 1)
point3f physics:localPos1 = (-0.5, 0, 0)
uniform token physics:axis = "Y"

}
def PhysicsRevoluteJoint "H1" (apiSchemas = []) {
rel physics:body1 = </C>
point3f physics:localPos0 = (0, 1, 1)
point3f physics:localPos1 = (-0.5, 0, 0)
uniform token physics:axis = "Y"

}
def MjcActuator "Act" {
rel mjc:target = </B/P>
rel mjc:sliderSite = </C/Q>
uniform double mjc:crankLength = 2
uniform double[] mjc:biasPrm = [1, 0, 0]
uniform token mjc:biasType = "affine"
uniform double mjc:ctrlRange:min = -1
uniform double mjc:ctrlRange:max = 1
uniform double mjc:actRange:min = -1
uniform double mjc:actRange:max = 1
uniform double mjc:forceRange:min = -1
uniform double mjc:forceRange:max = 1
uniform token mjc:dynType = "integrator"
@
}
)"},
      {"PhysxParticleSystem", "", R"(def PhysicsScene "S" {
vector3f physics:gravityDirection = (0, 0, -1)
float physics:gravityMagnitude = 10
}
def PhysxParticleSystem "P" {
double3 xformOp:translate = (1, 0, 0)
uniform token[] xformOpOrder = ["xformOp:translate"]
@
def Cube "Shape" (apiSchemas = ["PhysicsCollisionAPI"]) {
double size = 0.4
}
}
)"},
      {"TetrahedralMesh", "", R"(def PhysicsScene "S" {
vector3f physics:gravityDirection = (0, 0, -1)
float physics:gravityMagnitude = 10
}
def TetrahedralMesh "P" {
double3 xformOp:translate = (1, 0, 0)
uniform token[] xformOpOrder = ["xformOp:translate"]
@
def Cube "Shape" (apiSchemas = ["PhysicsCollisionAPI"]) {
double size = 0.4
}
}
)"},
  };
}

}  // namespace tenon::engines::mujoco
