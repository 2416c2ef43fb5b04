"""Names under which programs write regions to cell arrays.

They are those of the command-line program: ``mesh_io/document/region_names.cpp``.
"""

from __future__ import annotations

# None of these is often an id of each cell, a part of a parallel run or a result. All are as plain_name() writes them.

# With one of the beginnings and one of the endings, a word is the name of a region.
_WORDS = frozenset(
    "region domain subdomain zone material mat medium block attribute marker tag label ref physical property prop "
    "section component entity family geometrical geometry elset elementary reference lithology facies rocktype "
    "soiltype realconstant".split()
)
_BEGINNINGS = ("", "cell", "element", "elem", "face", "triangle", "mesh")
_ENDINGS = (
    "",
    *"s id ids no num number numbers index indices tag tags marker markers label labels ref type name names attribute "
    "entity entities group groups".split(),
)

# These are names as they are.
_WHOLE_NAMES = frozenset(
    # Of no program
    "media properties families subdomaindata imat partid partids groupid stratigraphy elementset elementsets "
    "elementgroup cellset cellsets cellgroup "
    # Gmsh, and what is made from its files
    "gmshphysical gmshgeometrical gmshphysicalids gmshgeometricalids physicalregion physicalregions physicalsurface "
    "physicalsurfaces elementaryentities elementaryids "
    # meshio: format:name
    "meditref freefemlabel 2dmmaterial mfemattribute triangleattribute nastranref nastranpid unvgroup unvpid tetgenref "
    "netgenindex su2tag su2marker su2zone avsucdmaterial flac3dgroup flac3dzone ansysmaterialid abaqusmaterial "
    "abaquselset nametoread "
    # FEniCS and dolfinx: MeshFunction, MeshTags
    "f meshfunction cellfunction meshtagsvalues celltagsvalues cellmarkersvalues "
    # MOOSE, libMesh, Exodus, Cubit, and ParaView's readers of these
    "objectid objectids exodusblock exodusblockid "
    # COMSOL
    "geometricentity geometricentityid geometricentityids geometricentityindex geometricentityindices "
    # Ansys
    "ansysmaterialtype ansysrealconstant ansyscomponent materialset "
    # Salome (MED)
    "familyidcell familyidelement medfamily "
    # VMTK, SimVascular, PyGIMLi, Netgen
    "modelregionid modelfaceid pygimlimarker netgenmaterial "
    # VTK and ParaView
    "vtkcompositeindex compositeindex vtkblockcolors vtkblockid vtkmaterialid stlsolidlabeling".split()
)


def plain_name(name: str) -> str:
    """Return the name without case, blanks and punctuation; letters of other alphabets stay as they are."""
    return "".join(c.lower() if c.isascii() else c for c in name if c.isalnum() or not c.isascii())


def is_region_name(name: str) -> bool:
    """Return whether programs write regions under that name of a cell array."""
    plain = plain_name(name)
    return plain in _WHOLE_NAMES or _is_made_of_words(plain)


def _is_made_of_words(name: str) -> bool:
    return any(
        name.startswith(beginning)
        and name.endswith(ending)
        and name[len(beginning) : len(name) - len(ending)] in _WORDS
        for beginning in _BEGINNINGS
        for ending in _ENDINGS
    )
