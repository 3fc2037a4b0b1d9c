(* SPDX-License-Identifier: LGPL-3.0-or-later *)
(* Polygons whose corners are near each other are: those inside and around a Voronoi cell [SHAPE-1]. *)
From Coq Require Import Reals Lra Psatz.
From Dyadel Require Import Plane Distance Cells Patches.
Open Scope R_scope.

Definition hull (C : point -> Prop) : point -> Prop := patch C (fun _ => False).

(* On the segment from a to b one is no farther from its like from x to y than the ends are. *)
Lemma mix_near t a b x y e : 0 <= t <= 1 -> dist a x <= e -> dist b y <= e -> dist (mix t a b) (mix t x y) <= e.
Proof.
  intros T A B. pose proof (dist_triangle (mix t a b) (mix t x b) (mix t x y)) as H.
  assert (P : dist (mix t a b) (mix t x b) = (1 - t) * dist a x) by (apply dist_scaled; [unfold dist2, mix; cbn; ring | lra]).
  assert (Q : dist (mix t x b) (mix t x y) = t * dist b y) by (apply dist_scaled; [unfold dist2, mix; cbn; ring | lra]).
  rewrite P, Q in H. assert ((1 - t) * dist a x <= (1 - t) * e) by (apply Rmult_le_compat_l; lra).
  assert (t * dist b y <= t * e) by (apply Rmult_le_compat_l; lra). lra.
Qed.

Lemma no_direction u : ~ cone (fun _ => False) u.
Proof. intros U. induction U; assumption. Qed.

(* What corners near those of a hull span is near it. *)
Theorem hull_near (C C' : point -> Prop) e : (forall z, C' z -> exists x, hull C x /\ dist z x <= e) ->
  forall z, hull C' z -> exists x, hull C x /\ dist z x <= e.
Proof.
  intros Near z H. induction H as [z H | a b t T _ (x & X & A) _ (y & Y & B) | c u t _ _ _ U]; [now apply Near | |].
  - exists (mix t x y). split; [now apply patch_mix | now apply mix_near].
  - now elim (no_direction u).
Qed.

(* Inner corners where i is surely the nearest, outer corners around all places where it may be, each near an inner one:
   the inner polygon is inside of Int_i, which is within e of it, and the outer one reaches no farther than e beyond. *)
Theorem shape_near N B i (inner outer : point -> Prop) e : (i < N)%nat -> (forall z, inner z -> int N B i z) ->
  (forall z, pos N B i z -> hull outer z) -> (forall z, outer z -> exists x, inner x /\ dist z x <= e) ->
  (forall z, hull inner z -> int N B i z) /\
  (forall z, pos N B i z -> exists x, hull inner x /\ dist z x <= e) /\
  (forall z, hull outer z -> exists x, int N B i x /\ dist z x <= e).
Proof.
  intros I In Out Near. assert (Inside : forall z, hull inner z -> int N B i z).
  { intros z H. induction H as [z H | a b t T _ A _ C | c u t _ _ _ U]; [now apply In | now apply int_convex |].
    now elim (no_direction u). }
  assert (Close : forall z, hull outer z -> exists x, hull inner x /\ dist z x <= e).
  { apply hull_near. intros z Z. destruct (Near z Z) as (x & X & D). exists x. split; [now apply patch_corner | exact D]. }
  split; [exact Inside |]. split; [intros z P; now apply Close, Out |].
  intros z H. destruct (Close z H) as (x & X & D). exists x. split; [now apply Inside | exact D].
Qed.
