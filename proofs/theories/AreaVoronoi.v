(* SPDX-License-Identifier: LGPL-3.0-or-later *)
(* V, area: the undetermined part of a window measures at most the area of the window less the areas of polygons whose
   vertices are in the cells Int. *)
From Coq Require Import Reals Lra Lia Psatz List.
From Dyadel Require Import Plane Distance Cells Orientation VoronoiBounds.
From Dyadel Require Import Measure MeasureCut MeasureTriangle.
Import ListNotations.
Open Scope R_scope.

(* Sets in the cells Int, of any shape: if each Int_i holds the area a_i within the window, at most the rest is
   undetermined. *)
Definition int_in (N : nat) (B : sites) (W : rect) (i : nat) (z : point) : Prop := int N B i z /\ inside z W.

Lemma ints_inner N B W a n : (n <= N)%nat -> (forall i, (i < N)%nat -> inner_ge (int_in N B W i) (a i)) ->
  inner_ge (fun z => exists i, (i < n)%nat /\ int_in N B W i z) (sum_below a n).
Proof.
  intros L H. induction n as [| n IH]; [apply inner_trivial; simpl; lra |]. simpl.
  apply (inner_union (fun z => exists i, (i < n)%nat /\ int_in N B W i z) (int_in N B W n)).
  - intros z [i [I [Z _]]] [Z' _]. apply (int_disjoint N B i n z); [lia | lia | lia | exact Z | exact Z'].
  - intros z [i [I Z]]. exists i. split; [lia | exact Z].
  - intros z Z. exists n. split; [lia | exact Z].
  - apply IH. lia.
  - apply H. lia.
Qed.

Theorem undetermined_area N B W a : (forall i, (i < N)%nat -> inner_ge (int_in N B W i) (a i)) ->
  measure_le (fun z => inside z W /\ undetermined N B z) (area W - sum_below a N).
Proof.
  intros H. apply measure_of_content.
  apply (content_subset _ (fun z => inside z W /\ ~ exists i, (i < N)%nat /\ int_in N B W i z) (area W - sum_below a N)).
  - intros z [Z U]. split; [exact Z |]. intros [i [I [K _]]]. exact (U i I K).
  - lra.
  - apply content_rest; [intros z [i [_ [_ Z]]]; exact Z | now apply ints_inner].
Qed.

(* Twice the area of a polygon as dyd_polygon_area2 computes it, from its first vertex o. *)
Fixpoint fan_area2 (o : point) (l : list point) : R :=
  match l with a :: ((b :: _) as r) => orient o a b + fan_area2 o r | _ => 0 end.
Definition polygon_area2 (P : list point) : R := match P with [] => 0 | o :: l => fan_area2 o l end.

(* The first vertex sees the others in counterclockwise order, as every vertex of a convex polygon does. *)
Definition in_order (o : point) (l : list point) : Prop := ForallOrdPairs (fun a b => 0 <= orient o a b) l.
Definition counterclockwise (P : list point) : Prop := match P with [] => True | o :: l => in_order o l end.

(* The triangles of the fan. *)
Fixpoint fan (o : point) (l : list point) (z : point) : Prop :=
  match l with a :: ((b :: _) as r) => triangle o a b z \/ fan o r z | _ => False end.

Lemma fan_side p q o l z : 0 <= orient p q o -> Forall (fun b => 0 <= orient p q b) l -> fan o l z -> 0 <= orient p q z.
Proof.
  intros Z. induction l as [| a l IH]; [intros _ [] |]. destruct l as [| b l]; [intros _ [] |]. intros F [T | T].
  - inversion F as [| ? ? Fa F']; subst. inversion F' as [| ? ? Fb _]; subst. now apply (triangle_side p q o a b z).
  - apply IH; [now inversion F | exact T].
Qed.

Lemma fan_inner o l : in_order o l -> inner_ge (fan o l) (fan_area2 o l / 2).
Proof.
  induction l as [| a l IH]; [intros _; apply inner_trivial; simpl; lra |].
  destruct l as [| b l]; [intros _; apply inner_trivial; simpl; lra |]. intros H. inversion H as [| ? ? _ H']; subst.
  replace (fan_area2 o (a :: b :: l) / 2) with (orient o a b / 2 + fan_area2 o (b :: l) / 2) by (simpl; field).
  apply (inner_union (triangle o a b) (fan o (b :: l))); [| simpl; tauto | simpl; tauto | apply triangle_inner | now apply IH].
  intros z [_ [_ O]] F. assert (0 <= orient o b z).
  { apply (fan_side o b o (b :: l)); [unfold orient; lra | | exact F]. inversion H' as [| ? ? G _]; subst. constructor; [unfold orient; lra | exact G]. }
  assert (orient b o z = - orient o b z) by (unfold orient; ring). unfold triangle in *. lra.
Qed.

(* A convex set with the vertices has the triangles. *)
Lemma triangle_in_convex (C : point -> Prop) a b c z : (forall x y t, 0 <= t <= 1 -> C x -> C y -> C (mix t x y)) ->
  C a -> C b -> C c -> triangle a b c z -> C z.
Proof.
  intros H A B D T. destruct (triangle_mean a b c z T) as [u [v [w [U [V [W [S [X Y]]]]]]]].
  replace z with (mix (v + w) a (mix (w / (v + w)) b c)).
  - apply H; [lra | exact A |]. apply H; [| exact B | exact D].
    split; [apply Rlt_le, Rdiv_lt_0_compat; lra |]. apply (Rmult_le_reg_r (v + w)); [lra |].
    replace (w / (v + w) * (v + w)) with w by (field; lra). lra.
  - unfold mix. simpl. destruct z as [x y]. simpl in X, Y. subst x y. replace u with (1 - v - w) by lra.
    f_equal; field; lra.
Qed.

Lemma fan_in_convex (C : point -> Prop) o l z : (forall x y t, 0 <= t <= 1 -> C x -> C y -> C (mix t x y)) ->
  C o -> (forall a, In a l -> C a) -> fan o l z -> C z.
Proof.
  intros H O. induction l as [| a l IH]; [intros _ [] |]. destruct l as [| b l]; [intros _ [] |]. intros L [T | T].
  - apply (triangle_in_convex C o a b z H); try assumption; apply L; simpl; tauto.
  - apply IH; [| exact T]. intros c I. apply L. now right.
Qed.

Lemma int_in_convex N B W i x y t : 0 <= t <= 1 -> int_in N B W i x -> int_in N B W i y -> int_in N B W i (mix t x y).
Proof. intros T [A C] [D E]. split; [now apply int_convex | now apply inside_convex]. Qed.

Theorem polygon_inner N B W i P : counterclockwise P -> (forall v, In v P -> inside v W /\ int N B i v) ->
  inner_ge (int_in N B W i) (polygon_area2 P / 2).
Proof.
  intros O V. destruct P as [| o l]; [apply inner_trivial; simpl; lra |].
  apply (inner_subset (fan o l) _ (fan_area2 o l / 2)); [| simpl; lra | now apply fan_inner].
  intros z. apply fan_in_convex.
  - intros x y t. apply int_in_convex.
  - split; apply V; now left.
  - intros a I. split; apply V; now right.
Qed.

(* V, area: with a polygon for each cell, its vertices in the cell and in the window. *)
Theorem voronoi_area N B W (P : nat -> list point) :
  (forall i, (i < N)%nat -> counterclockwise (P i)) ->
  (forall i v, (i < N)%nat -> In v (P i) -> inside v W /\ int N B i v) ->
  measure_le (fun z => inside z W /\ undetermined N B z)
             (area W - sum_below (fun i => polygon_area2 (P i) / 2) N).
Proof.
  intros O V. apply undetermined_area. intros i I. apply polygon_inner; [now apply O |]. intros v K. now apply V.
Qed.
