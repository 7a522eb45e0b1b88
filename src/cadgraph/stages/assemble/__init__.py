"""Putting the results of all stages together as one graph."""

from __future__ import annotations

from cadgraph._io.garbage import collector_paused
from cadgraph.model.graph import SceneGraph
from cadgraph.model.records import Contains, Edge, GraphDocument, Node, Related, Site, SourceRecord
from cadgraph.model.vocabulary import Vocabulary
from cadgraph.stages.assemble.network import (
    connected,
    joint_records,
    place_nodes,
    stated_links,
    systems_of,
    unit_records,
)
from cadgraph.stages.assemble.parts import (
    SITE,
    adjacency,
    cluster_records,
    findings,
    held_parts,
    ids_of_clusters,
    ids_of_parts,
    part_records,
)
from cadgraph.stages.assemble.places import level_records, reached_edges
from cadgraph.stages.assemble.results import Results, fact_records

__all__ = ["Results", "assemble_graph"]


def assemble_graph(results: Results, vocabulary: Vocabulary, config: dict[str, object]) -> SceneGraph:
    """Makes the graph; ids are numbered in the order of parts, clusters and units.

    Args:
        results: of all stages.
        vocabulary: the tree in use.
        config: every setting in force, as plain values.
    """
    with collector_paused():
        return _assembled(results, vocabulary, config)


def _assembled(results: Results, vocabulary: Vocabulary, config: dict[str, object]) -> SceneGraph:
    scene, parts, part_ids = results.scene, results.parts, ids_of_parts(results.parts)
    above = results.places.of_units([unit.parts for unit in results.network.units]) if results.places else ()
    site = Site(id=SITE, facts=fact_records(results.places.left_over(above) if results.places else ()))
    clusters = cluster_records(results, ids_of_clusters(results.cluster))
    units = unit_records(results, part_ids, above)
    edges: list[Edge] = [Contains(source=site.id, target=cluster.id) for cluster in clusters]
    edges += held_parts(parts, results.cluster)
    edges += [Contains(source=unit.id, target=part) for unit in units for part in unit.parts]
    edges += adjacency(results.contacts, results.cluster, parts, scene)
    edges += [Related(source=units[a].id, target=units[b].id) for a, b in results.related]
    places = place_nodes(results, part_ids)
    ends = [node.id for node in (*units, *places)]
    edges += [connected(link, results, ends, part_ids) for link in results.network.links]
    systems = systems_of(results, ends)
    edges += [Contains(source=s.id, target=node) for s in systems for node in (*s.units, *s.junctions, *s.terminals)]
    levels = level_records(results, part_ids)
    edges += reached_edges(results, levels, units)
    nodes: tuple[Node, ...] = (site, *clusters, *part_records(results), *units, *places, *systems, *levels)
    return SceneGraph(
        GraphDocument(
            source=SourceRecord(
                path=scene.source.path,
                sha256=scene.source.sha256,
                meters_per_unit=scene.source.meters_per_unit,
                up_axis=scene.source.up_axis,
                n_meshes=scene.n_meshes,
                n_triangles=scene.n_triangles,
                referred=scene.source.referred,
            ),
            vocabulary=vocabulary.to_json(),
            config=config,
            nodes=nodes,
            edges=tuple(edges),
            joints=tuple(joint_records(results, part_ids)),
            stated=tuple(stated_links(results, part_ids)),
            diagnostics=tuple(findings(results)),
        )
    )
