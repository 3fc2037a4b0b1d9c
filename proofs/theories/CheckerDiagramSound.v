(* SPDX-License-Identifier: LGPL-3.0-or-later *)
(* When the checker finds the polygons kept, their vertices are in the cells Int and in the window, and what of the window
   is undetermined measures at most the bound. *)
From Coq Require Import Reals Lra Lia Psatz ZArith List Bool.
From Dyadel Require Import Plane Distance Cells Legal Orientation VoronoiBounds.
From Dyadel Require Import Measure MeasureCut MeasureTriangle AreaVoronoi AreaChains.
From Dyadel Require Import Checker CheckerSound CheckerBounds CheckerCover CheckerBoundsSound CheckerDiagram.
Import ListNotations.
Open Scope R_scope.

(* ---- lists ---- *)

Lemma begun_at_in o before l x : In x (begun_at o before l) -> In x before \/ In x l.
Proof.
  revert before. induction l as [| a l IH]; intros before H; simpl in H.
  - rewrite rev_append_rev, app_nil_r in H. apply in_rev in H. now left.
  - destruct (same o a).
    + destruct H as [<- | H]; [right; now left |]. rewrite !rev_append_rev, !app_nil_r, rev_involutive in H.
      apply in_app_or in H. destruct H as [H | H]; [right; now right | left; now apply in_rev].
    + destruct (IH _ H) as [[<- | I] | I]; [right; now left | now left | right; now right].
Qed.

Lemma begun_in l x : In x (begun l) -> In x l.
Proof. unfold begun. destruct l as [| a l]; [easy |]. intros H. now destruct (begun_at_in _ _ _ _ H). Qed.

Lemma scaled_dots_all D E l before ds : scaled_dots D E l before = Some ds ->
  exists cs, ds = rev_append before cs /\
    Forall2 (fun p a => scaled D E (fst p) = Some (fst a) /\ scaled D E (snd p) = Some (snd a)) l cs.
Proof.
  revert before. induction l as [| p l IH]; intros before H; simpl in H.
  - injection H as <-. now exists [].
  - destruct (scaled D E (fst p)) as [x |] eqn:X; [| discriminate]. destruct (scaled D E (snd p)) as [y |] eqn:Y; [| discriminate].
    destruct (IH _ H) as (cs & -> & F). exists ((x, y) :: cs). split; [reflexivity | now constructor].
Qed.

(* ---- one polygon ---- *)

Section Scaled.
Variable U : R.
Variable positive : 0 < U.

(* The point of a dot. *)
Definition at_dot (a : dot) : point := (IZR (fst a) / U, IZR (snd a) / U).

Lemma bend_value a b c : orient (at_dot a) (at_dot b) (at_dot c) = IZR (bend a b c) / (U * U).
Proof. unfold orient, at_dot, bend. simpl. rewrite minus_IZR, !mult_IZR, !minus_IZR. field. lra. Qed.

Lemma square_positive : 0 < / (U * U).
Proof. apply Rinv_0_lt_compat. nra. Qed.

Lemma bend_positive a b c : (0 < bend a b c)%Z -> 0 < orient (at_dot a) (at_dot b) (at_dot c).
Proof. intros H. rewrite bend_value. apply IZR_lt in H. apply Rmult_lt_0_compat; [exact H | exact square_positive]. Qed.

Lemma goes_on_lex a b : goes_on a b = true -> lex (at_dot a) (at_dot b).
Proof.
  unfold goes_on, lex, at_dot. simpl. rewrite orb_true_iff, andb_true_iff, !Z.ltb_lt, Z.eqb_eq, Z.leb_le.
  assert (P : 0 < / U) by now apply Rinv_0_lt_compat. unfold Rdiv. intros [H | [-> H]].
  - left. apply IZR_lt in H. now apply Rmult_lt_compat_r.
  - right. split; [reflexivity |]. apply IZR_le in H. apply Rmult_le_compat_r; lra.
Qed.

Lemma fan_twice_sound o l : forall a before z, fan_twice o a l before = Some z ->
  fan_area2 (at_dot o) (map at_dot (a :: l)) = (IZR z - IZR before) / (U * U) /\
  steps (fun p q => 0 < orient (at_dot o) p q) (map at_dot (a :: l)).
Proof.
  induction l as [| b l IH]; intros a before z H.
  - simpl in H. injection H as <-. simpl. split; [unfold Rdiv; ring | exact Logic.I].
  - cbn [fan_twice] in H. cbv zeta in H. destruct (0 <? bend o a b)%Z eqn:T; [| discriminate]. apply Z.ltb_lt in T.
    destruct (IH b _ z H) as [A S]. rewrite plus_IZR in A. split.
    + change (fan_area2 (at_dot o) (map at_dot (a :: b :: l)))
        with (orient (at_dot o) (at_dot a) (at_dot b) + fan_area2 (at_dot o) (map at_dot (b :: l))).
      rewrite A, bend_value. field. lra.
    + change (0 < orient (at_dot o) (at_dot a) (at_dot b) /\
        steps (fun p q => 0 < orient (at_dot o) p q) (map at_dot (b :: l))). split; [now apply bend_positive | exact S].
Qed.

Lemma polygon_twice_sound l z : polygon_twice l = Some z -> exists P, counterclockwise P /\
  polygon_area2 P = IZR z / (U * U) /\ forall v, In v P -> exists a, In a l /\ v = at_dot a.
Proof.
  unfold polygon_twice. destruct (begun l) as [| o [| a [| b rest]]] eqn:Q; try discriminate.
  destruct (forallb _ _) eqn:F; [| discriminate]. destruct (turns_left _ _ _); [| discriminate].
  cbn [andb]. intros H. rewrite forallb_forall in F. destruct (fan_twice_sound _ _ _ _ _ H) as [A S].
  exists (map at_dot (o :: a :: b :: rest)). split; [| split].
  - apply steps_in_order; [| exact S]. intros x I. change (In x (map at_dot (a :: b :: rest))) in I.
    apply in_map_iff in I. destruct I as [c [<- I]]. apply goes_on_lex. now apply F.
  - change (fan_area2 (at_dot o) (map at_dot (a :: b :: rest)) = IZR z / (U * U)). rewrite A. f_equal. ring.
  - intros v I. apply in_map_iff in I. destruct I as [c [<- I]]. exists c. split; [| reflexivity].
    apply begun_in. now rewrite Q.
Qed.
End Scaled.

(* ---- all of them ---- *)

Section Kept.
Variables (D E : Z) (l : list site) (B : sites) (W : rect) (w : box) (bs : list box).
Variable accepted : check D E l [] = true.
Variable described : describes l B.
Variable scale : scaled_sites D E l = Some bs.
Variable framed : is_box (unit D E) w W.

Notation N := (length l).
Notation U := (unit D E).

Lemma with_edge e : check_edge D E (index box_name bs) (build deepest bs) e = true -> check D E l [e] = true.
Proof.
  intros H. unfold check in *. rewrite scale in *. apply andb_true_iff in accepted. destruct accepted as [A _].
  apply andb_true_iff. split; [exact A |]. apply andb_true_iff. now split.
Qed.

Lemma unit_positive : 0 < U.
Proof. destruct (accepted_parts D E l [] accepted) as (bs' & _ & P & _). now apply unit_pos. Qed.

(* A vertex that passes is in the cell Int of the owner. *)
Lemma inner_sound i p a : scaled D E (fst p) = Some (fst a) -> scaled D E (snd p) = Some (snd a) ->
  is_inner (index box_name bs) (build deepest bs) i a = true ->
  at_dot U a = (value (fst p), value (snd p)) /\ exists k, named l k i /\ int N B k (at_dot U a).
Proof.
  intros X Y H. set (e := Edge i i (fst p) (snd p)).
  assert (C : check D E l [e] = true) by (apply with_edge; unfold check_edge, e; simpl; now rewrite X, Y).
  pose proof unit_positive as P.
  assert (V : at_dot U a = (value (fst p), value (snd p))).
  { unfold at_dot. rewrite (scaled_value D E _ _ X), (scaled_value D E _ _ Y). f_equal; field; lra. }
  split; [exact V |].
  destruct (accepted_names D E l [e] B C described e (or_introl eq_refl)) as [[k K] _]. exists k. split; [exact K |].
  rewrite V. intros j J M. exact (proj1 (accepted_witness D E l [e] B C described e k k (or_introl eq_refl) K K j J M M)).
Qed.

Lemma window_sound a : is_within_window w a = true -> inside (at_dot U a) W.
Proof.
  unfold is_within_window. rewrite !andb_true_iff, !Z.leb_le. intros [[[X0 X1] Y0] Y1].
  destruct framed as (A & A' & C & C'). pose proof unit_positive as P. apply IZR_le in X0, X1, Y0, Y1.
  assert (G : forall u z : R, u * U <= z -> u <= z / U).
  { intros u z H. apply (Rmult_le_reg_r U); [exact P |]. replace (z / U * U) with z by (field; lra). exact H. }
  assert (G' : forall u z : R, z <= u * U -> z / U <= u).
  { intros u z H. apply (Rmult_le_reg_r U); [exact P |]. replace (z / U * U) with z by (field; lra). exact H. }
  unfold inside, at_dot. simpl. repeat split; (apply G || apply G'); lra.
Qed.

Lemma named_once k i j : named l k i -> named l k j -> i = j.
Proof. intros [s [S <-]] [t [T <-]]. congruence. Qed.

Lemma named_below k i : named l k i -> (k < N)%nat.
Proof. intros [s [S _]]. apply nth_error_Some. congruence. Qed.

Lemma named_apart k j i : named l k i -> named l j i -> k = j.
Proof.
  intros [s [S Ns]] [t [T Nt]]. destruct (accepted_parts D E l [] accepted) as (bs' & H & P & R0 & _).
  destruct (box_of D E l B described k (named_below k i ltac:(now exists s)) bs' H P) as (s' & b & S' & Tb & Nb & _).
  destruct (box_of D E l B described j (named_below j i ltac:(now exists t)) bs' H P) as (t' & c & T' & Tc & Nc & _).
  apply (rising_names (-1) bs' k j b c R0 Tb Tc). congruence.
Qed.

(* The vertices of a polygon that passes are in the cell of its owner, and so is the polygon; its area. *)
Lemma polygon_sound p z : polygon_holds D E (index box_name bs) (build deepest bs) w p = Some z ->
  exists k, named l k (owner p) /\ (forall v, In v (vertices p) -> int_in N B W k (value (fst v), value (snd v))) /\
    inner_ge (int_in N B W k) (IZR z / (U * U) / 2).
Proof.
  unfold polygon_holds. destruct (scaled_dots D E (vertices p) []) as [ds |] eqn:Q; [| discriminate].
  destruct (forallb _ ds) eqn:F; [| discriminate]. intros H. rewrite forallb_forall in F.
  destruct (scaled_dots_all _ _ _ _ _ Q) as (cs & E1 & S). simpl in E1. subst cs.
  destruct (polygon_twice_sound U unit_positive ds z H) as (P & O & A & V).
  assert (L : forall v a, scaled D E (fst v) = Some (fst a) -> scaled D E (snd v) = Some (snd a) -> In a ds ->
    at_dot U a = (value (fst v), value (snd v)) /\ exists k, named l k (owner p) /\ int_in N B W k (at_dot U a)).
  { intros v a X Y I. specialize (F a I). apply andb_true_iff in F. destruct F as [F G].
    destruct (inner_sound _ v a X Y G) as [T [k [K C]]]. split; [exact T |]. exists k. split; [exact K |].
    split; [exact C | now apply window_sound]. }
  assert (Back : forall a, In a ds -> exists v, In v (vertices p) /\ scaled D E (fst v) = Some (fst a) /\ scaled D E (snd v) = Some (snd a)).
  { clear - S. induction S as [| v a vs ds X S IH]; [easy |]. intros b [<- | I]; [exists v; split; [now left | tauto] |].
    destruct (IH b I) as [u [J T]]. exists u. split; [now right | exact T]. }
  assert (Forth : forall v, In v (vertices p) -> exists a, In a ds /\ scaled D E (fst v) = Some (fst a) /\ scaled D E (snd v) = Some (snd a)).
  { clear - S. induction S as [| v a vs ds X S IH]; [easy |]. intros b [<- | I]; [exists a; split; [now left | tauto] |].
    destruct (IH b I) as [u [J T]]. exists u. split; [now right | exact T]. }
  assert (K : exists k, named l k (owner p)).
  { destruct ds as [| a ds]; [unfold polygon_twice in H; simpl in H; discriminate |].
    destruct (Back a (or_introl eq_refl)) as (v & _ & X & Y). destruct (L v a X Y (or_introl eq_refl)) as [_ [k [K _]]].
    now exists k. }
  destruct K as [k K]. exists k. split; [exact K |]. split.
  - intros v I. destruct (Forth v I) as (a & J & X & Y). destruct (L v a X Y J) as [<- [j [K' C]]].
    now rewrite (named_apart k j (owner p) K K').
  - rewrite <- A. apply polygon_inner; [exact O |]. intros v I. destruct (V v I) as (a & J & ->).
    destruct (Back a J) as (u & _ & X & Y). destruct (L u a X Y J) as [_ [j [K' [C C']]]].
    rewrite (named_apart k j (owner p) K K'). now split.
Qed.

(* What sites of greater numbers have of the window. *)
Definition of_later (last : Z) (z : point) : Prop := exists k i, named l k i /\ (last < i)%Z /\ int_in N B W k z.

Lemma polygons_sound ps : forall last before z,
  polygons_onto D E (index box_name bs) (build deepest bs) w last ps before = Some z ->
  (forall p v, In p ps -> In v (vertices p) ->
    exists k, named l k (owner p) /\ int_in N B W k (value (fst v), value (snd v))) /\
  inner_ge (of_later last) ((IZR z - IZR before) / (U * U) / 2).
Proof.
  induction ps as [| p ps IH]; intros last before z H; cbn [polygons_onto] in H.
  - injection H as <-. split; [now intros p v [] |]. apply inner_trivial. unfold Rdiv. right. ring.
  - destruct (last <? owner p)%Z eqn:O; [| discriminate]. apply Z.ltb_lt in O.
    destruct (polygon_holds _ _ _ _ _ p) as [y |] eqn:Q; [| discriminate].
    destruct (polygon_sound p y Q) as (k & K & V & A). destruct (IH _ _ _ H) as [G C]. split.
    + intros q v [<- | I] J; [exists k; split; [exact K | now apply V] | exact (G q v I J)].
    + rewrite plus_IZR in C.
      replace ((IZR z - IZR before) / (U * U) / 2) with (IZR y / (U * U) / 2 + (IZR z - (IZR before + IZR y)) / (U * U) / 2)
        by (pose proof unit_positive; field; lra).
      apply (inner_union (int_in N B W k) (of_later (owner p))); [| | | exact A | exact C].
      * intros x [X _] [j [i [J [L [Y _]]]]]. apply (int_disjoint N B k j x); try (eapply named_below; eassumption); try assumption.
        intros <-. pose proof (named_once k _ _ K J). lia.
      * intros x X. now exists k, (owner p).
      * intros x [j [i [J [L Y]]]]. exists j, i. split; [exact J |]. split; [lia | exact Y].
Qed.
End Kept.

(* ---- the section ---- *)

Section Section.
Variables (D E : Z) (l : list site) (w : window) (ps : list polygon) (B : sites) (W : rect).
Variable described : describes l B.
Variable framed : describes [w] (fun _ => W).

Lemma twice_sound z b : polygons_twice D E l w ps = Some (z, b) ->
  (0 < D)%Z /\ is_box (unit D E) b W /\
  (forall p v, In p ps -> In v (vertices p) ->
    exists k, named l k (owner p) /\ int_in (length l) B W k (value (fst v), value (snd v))) /\
  inner_ge (of_later l B W (-1)) (IZR z / (unit D E * unit D E) / 2).
Proof.
  unfold polygons_twice. destruct (scaled_sites D E l) as [bs |] eqn:Sc; [| discriminate].
  destruct (scaled_site D E w) as [b' |] eqn:Sw; [| discriminate].
  destruct (check D E l []) eqn:C; [| discriminate]. destruct (x0 b' <? x1 b')%Z; [| discriminate].
  destruct (y0 b' <? y1 b')%Z; [| discriminate]. cbn [andb].
  destruct (polygons_onto _ _ _ _ _ _ _ _) as [z' |] eqn:Q; [| discriminate]. intros H. injection H as <- <-.
  destruct (accepted_parts D E l [] C) as (bs' & _ & P & _). destruct (framed 0%nat w eq_refl) as (X0 & X1 & Y0 & Y1).
  destruct (scaled_site_box D E w b' W P Sw X0 X1 Y0 Y1) as [I _].
  destruct (polygons_sound D E l B W b' bs C described Sc I ps _ _ _ Q) as [G A].
  split; [exact P |]. split; [exact I |]. split; [exact G |]. now rewrite Rminus_0_r in A.
Qed.

(* Each polygon, the hull of its vertices, lies in the cell Int of its owner, and in the window. *)
Theorem accepted_polygon p z : polygons_hold D E l w ps = true -> In p ps ->
  (exists o r, vertices p = o :: r /\ fan (value (fst o), value (snd o)) (map (fun v => (value (fst v), value (snd v))) r) z) ->
  exists k, named l k (owner p) /\ int (length l) B k z /\ inside z W.
Proof.
  unfold polygons_hold. destruct (polygons_twice D E l w ps) as [[y b] |] eqn:Q; [| discriminate]. intros _ I (o & r & V & F).
  destruct (twice_sound y b Q) as (_ & _ & G & _).
  assert (C : check D E l [] = true).
  { unfold polygons_twice in Q. destruct (scaled_sites D E l); [| discriminate]. destruct (scaled_site D E w); [| discriminate].
    now destruct (check D E l []). }
  destruct (G p o I) as (k & K & O); [rewrite V; now left |]. exists k. split; [exact K |].
  apply (fan_in_convex (int_in (length l) B W k) (value (fst o), value (snd o))
    (map (fun v => (value (fst v), value (snd v))) r) z); [| exact O | | exact F].
  - intros x x' t. apply int_in_convex.
  - intros a J. apply in_map_iff in J. destruct J as [v [<- J]]. destruct (G p v I) as (j & K' & O'); [rewrite V; now right |].
    now rewrite (named_apart D E l B C described k j (owner p) K K').
Qed.

(* What of the window is in no cell Int measures at most the bound. *)
Theorem accepted_undetermined bound : undetermined_holds D E l w ps bound = true ->
  measure_le (fun z => inside z W /\ undetermined (length l) B z) (value bound).
Proof.
  unfold undetermined_holds. destruct (polygons_twice D E l w ps) as [[y b] |] eqn:Q; [| discriminate].
  destruct (twice_sound y b Q) as (P & (X0 & X1 & Y0 & Y1) & _ & A). intros H. pose proof (unit_pos D E P) as U.
  apply (at_most_value _ _ _ _ P) in H. rewrite minus_IZR, !mult_IZR, !minus_IZR, X0, X1, Y0, Y1 in H.
  assert (V : value (Number (2 * man bound) (expo bound) (den bound)) = 2 * value bound).
  { unfold value. cbn [man expo den]. rewrite mult_IZR. unfold Rdiv. ring. }
  rewrite V in H. apply measure_of_content.
  apply (content_subset _ (fun z => inside z W /\ ~ of_later l B W (-1) z)
    (Measure.area W - IZR y / (unit D E * unit D E) / 2)).
  - intros z [Z0 T]. split; [exact Z0 |]. intros (k & i & K & _ & C & _). exact (T k (named_below l k i K) C).
  - unfold Measure.area. assert (U2 : 0 < unit D E * unit D E) by nra. apply (Rmult_le_reg_l (2 * (unit D E * unit D E))); [lra |].
    replace (2 * (unit D E * unit D E) * ((xhi W - xlo W) * (yhi W - ylo W) - IZR y / (unit D E * unit D E) / 2))
      with (2 * ((xhi W * unit D E - xlo W * unit D E) * (yhi W * unit D E - ylo W * unit D E)) - IZR y) by (field; lra).
    lra.
  - apply content_rest; [intros z (k & i & _ & _ & _ & C); exact C | exact A].
Qed.
End Section.
