(* SPDX-License-Identifier: LGPL-3.0-or-later *)
(* The filters for an edge by the triangles next to it, in a Delaunay triangulation of the representatives: their
   circles are empty, and a distance at most that to all neighbours of i and j in the mesh is at most that to all other
   sites [WIT-NEAR] [WIT-HULL]. *)
From Coq Require Import Reals Lra Lia.
From Flocq Require Import Core Binary.
From Dyadel Require Import Plane Distance Cells Legal Orientation TiedRim Inserted MeshNeighbours.
From Dyadel Require Import FiltersBase FiltersNearPlane FiltersNearCode FiltersNearHull.
Open Scope R_scope.

Section Mesh.
Variables (N : nat) (p : nat -> point) (T : mesh).
Variable skeleton : delaunay N p (fun k => (k < N)%nat) T.
Variable distinct : forall v w, (v < N)%nat -> (w < N)%nat -> v <> w -> p v <> p w.

(* M is at most the distance from p a to every neighbour in the mesh. *)
Definition nearest_from (M : R) (a : nat) : Prop := forall s, next_to N T a s -> M <= dist (p a) (p s).

Lemma mesh_alone M i j k : T i j k -> (i < N)%nat -> (j < N)%nat -> (k < N)%nat -> i <> j ->
  nearest_from M i -> nearest_from M j -> alone N p M i j.
Proof.
  intros F I J K D Mi Mj. pose proof (turned N p T skeleton _ _ _ F) as G.
  assert (At : forall a q, a = i \/ a = j -> (q < N)%nat -> q <> a -> M <= dist (p a) (p q)).
  { intros a q [-> | ->] Q Dq.
    - destruct (nearest_beside N p T skeleton distinct i j k q F I J K Q Dq) as (s & S & L). specialize (Mi s S). lra.
    - destruct (nearest_beside N p T skeleton distinct j k i q G J K I Q Dq) as (s & S & L). specialize (Mj s S). lra. }
  split; [apply At; auto |]. intros q Q Qi Qj. rewrite !(dist_sym (p q)). split; apply At; auto.
Qed.

Lemma mesh_empty i j k : T i j k -> (i < N)%nat -> (j < N)%nat -> (k < N)%nat ->
  exists c, empty_circle N p c i j k /\ empty_circle N p c j i k.
Proof.
  intros F I J K. destruct (mesh_circle N p T skeleton i j k F I J K) as (_ & o & Ej & Ek & Out).
  assert (Dj : dist o (p i) = dist o (p j)) by (apply dist_eq; unfold about in Ej; lra).
  assert (Dk : dist o (p k) = dist o (p i)) by (apply dist_eq; unfold about in Ek; lra).
  assert (Q : forall q, (q < N)%nat -> dist o (p i) <= dist o (p q)).
  { intros q L. apply dist_le. specialize (Out q L). unfold about in Out. lra. }
  exists o. split; (split; [lra |]; split; [lra |]); [exact Q | rewrite <- Dj; exact Q].
Qed.
End Mesh.

Theorem mesh_edge_near N B (x y : nat -> double) T i j k l reach m M :
  let p q := (val (x q), val (y q)) in
  delaunay N p (fun q => (q < N)%nat) T -> (forall v w, (v < N)%nat -> (w < N)%nat -> v <> w -> p v <> p w) ->
  T i j k -> T j i l -> (i < N)%nat -> (j < N)%nat -> (k < N)%nat -> (l < N)%nat ->
  finite reach -> bpow radix2 (-300) <= val reach -> within N B p (val reach) ->
  nearest_from N p T M i -> nearest_from N p T M j -> finite m -> val m <= M * (1 + / 10 ^ 12) ->
  filter_edge_near (x i) (y i) (x j) (y j) (x k) (y k) (x l) (y l) reach m = true ->
  exists c1 c2, empty_circle N p c1 i j k /\ empty_circle N p c2 i j l /\ witness N B i j (mix (1 / 2) c1 c2).
Proof.
  intros p Sk Di F G I J K L Fr Er W Mi Mj Fm Hm H.
  assert (Dij : i <> j) by (now destruct (proj1 Sk _ _ _ F) as (_ & X & _)).
  destruct (mesh_empty N p T Sk i j k F I J K) as (c1 & E1 & _).
  destruct (mesh_empty N p T Sk j i l G J I L) as (c2 & _ & E2).
  exists c1, c2. split; [exact E1 |]. split; [exact E2 |].
  apply (filter_edge_near_correct N B x y i j k l c1 c2 reach m M); try assumption.
  now apply (mesh_alone N p T Sk Di M i j k).
Qed.

Theorem mesh_hull_edge_near N B (x y : nat -> double) T i j k reach m M :
  let p q := (val (x q), val (y q)) in
  delaunay N p (fun q => (q < N)%nat) T -> (forall v w, (v < N)%nat -> (w < N)%nat -> v <> w -> p v <> p w) ->
  T i j k -> T j i N -> (i < N)%nat -> (j < N)%nat -> (k < N)%nat ->
  finite reach -> bpow radix2 (-300) <= val reach -> within N B p (val reach) ->
  nearest_from N p T M i -> nearest_from N p T M j -> finite m -> val m <= M * (1 + / 10 ^ 12) ->
  filter_hull_edge_near (x i) (y i) (x j) (y j) (x k) (y k) reach m = true ->
  exists c1, empty_circle N p c1 i j k /\ witness N B i j (across (p i) (p j) c1 (dist c1 (p i))).
Proof.
  intros p Sk Di F G I J K Fr Er W Mi Mj Fm Hm H.
  assert (Dij : i <> j) by (now destruct (proj1 Sk _ _ _ F) as (_ & X & _)).
  destruct (mesh_empty N p T Sk i j k F I J K) as (c1 & E1 & _). exists c1. split; [exact E1 |].
  apply (filter_hull_edge_near_correct N B x y i j k c1 reach m M); try assumption.
  - now apply (mesh_alone N p T Sk Di M i j k).
  - intros q Q. pose proof (nobody_beyond N p T Sk j i q G J I Q) as Z. change (0 <= cross_at (p i) (p j) (p q)).
    replace (cross_at (p i) (p j) (p q)) with (- orient (p j) (p i) (p q)) by (unfold cross_at, orient; ring). lra.
Qed.
