(* SPDX-License-Identifier: LGPL-3.0-or-later *)
(* When the checker finds the window covered, every point of it that is undetermined is within the bound of the diagram of
   every choice. *)
From Coq Require Import Reals Lra Lia Psatz ZArith List Bool Classical.
From Dyadel Require Import Plane Finite Distance Cells Legal VoronoiBounds Bounds.
From Dyadel Require Import Checker CheckerSound CheckerComplete CheckerBounds CheckerBoundsSound CheckerCover CheckerCoverSound CheckerDistance.
Import ListNotations.
Open Scope R_scope.

(* ---- one point ---- *)

(* As voronoi_hausdorff, when the one or the other holds of each pair that shares z. *)
Theorem undetermined_near N B p z h : (1 <= N)%nat -> 0 <= h -> choice N B p -> undetermined N B z ->
  (forall i j, (i < N)%nat -> (j < N)%nat -> i <> j -> pos N B i z -> pos N B j z ->
    (exists k, (k < N)%nat /\ VoronoiBounds.apart (B i) (B k) /\ dl z (B k) <= h) \/
    (exists s di dj, 0 < s /\ (forall x y, inside x (B i) -> inside y (B j) -> s <= dist x y) /\
      diameter_le (B i) di /\ diameter_le (B j) dj /\ (di + dj) * (dl z (B i) + dl z (B j)) <= 2 * h * s)) ->
  exists w, diagram N p w /\ dist z w <= h.
Proof.
  intros N1 H0 P U H.
  destruct (finite_min (fun _ => True) (fun k => dist z (p k)) N) as [i [I [_ Li]]].
  { exists 0%nat. split; [lia | exact Logic.I]. }
  assert (C : cell N p i z) by (intros k K; now apply Li).
  assert (N2 : (2 <= N)%nat).
  { destruct (le_lt_dec 2 N) as [L | L]; [exact L |]. exfalso. apply (U 0%nat); [lia |]. intros j J M. lia. }
  destruct (finite_min (fun k => k <> i) (fun k => ds z (B k)) N) as [j [J [D Lj]]].
  { destruct i; [exists 1%nat | exists 0%nat]; lia. }
  assert (W : ds z (B j) <= dl z (B i)).
  { apply NNPP. intros X. apply (U i I). intros k K Dk. pose proof (Lj k K Dk). lra. }
  assert (Pi : pos N B i z) by (apply pos_exact; [exact I | now exists p]).
  assert (Pj : pos N B j z).
  { intros k K. destruct (Nat.eq_dec k i) as [-> | Dk]; [exact W |]. pose proof (Lj k K Dk). pose proof (ds_le_dl z (B k)). lra. }
  destruct (H i j I J (not_eq_sym D) Pi Pj) as [[k [K [A L]]] | [s [di [dj [S [Sep [Di [Dj M]]]]]]]].
  - apply (other_point_near N p i k); try assumption; [now apply (apart_differ N B p i k) |].
    pose proof (le_dl z _ _ (P k K)). lra.
  - pose proof (Sep _ _ (P i I) (P j J)) as Far.
    assert (Ne : p i <> p j) by (intros E; rewrite E, dist_self in Far; lra).
    assert (A1 : dist z (p j) <= ds z (B j) + dj).
    { pose proof (dist_triangle z (nearest z (B j)) (p j)). pose proof (Dj _ _ (nearest_inside z (B j)) (P j J)). unfold ds. lra. }
    assert (A2 : dl z (B i) <= dist z (p i) + di).
    { pose proof (dist_triangle z (p i) (farthest z (B i))). pose proof (Di _ _ (P i I) (farthest_inside z (B i))). unfold dl. lra. }
    pose proof (le_dl z _ _ (P i I)) as A3. pose proof (le_dl z _ _ (P j J)) as A4. pose proof (C j J) as A5.
    destruct (reach_bisector z (p i) (p j) h Ne H0) as [y [Y1 Y2]].
    { rewrite <- !dist_sq. pose proof (dist_nonneg z (p i)).
      replace (dist z (p j) * dist z (p j) - dist z (p i) * dist z (p i))
        with ((dist z (p j) - dist z (p i)) * (dist z (p j) + dist z (p i))) by ring.
      apply Rle_trans with ((di + dj) * (dl z (B i) + dl z (B j))); [apply Rmult_le_compat; lra |].
      apply Rle_trans with (2 * h * s); [exact M |].
      assert (h * s <= h * dist (p i) (p j)) by (apply Rmult_le_compat_l; lra). lra. }
    destruct (way_meets_diagram N p i j z y I J (not_eq_sym Ne) C Y2) as [t [T G]].
    exists (mix t z y). split; [exact G |]. rewrite dist_mix_left by lra. pose proof (dist_nonneg z y).
    assert (t * dist z y <= 1 * dist z y) by (apply Rmult_le_compat_r; lra). lra.
Qed.

(* ---- boxes ---- *)

(* The point is in the box, in units of 1 / S. *)
Definition in_box (S : R) (b : box) (x : point) : Prop :=
  IZR (x0 b) <= S * fst x <= IZR (x1 b) /\ IZR (y0 b) <= S * snd x <= IZR (y1 b).

Lemma length2_above S a b x y : in_box S a x -> in_box S b y -> S * S * dist2 x y <= IZR (length2 a b).
Proof.
  intros [Ax Ay] [Bx By]. unfold length2. cbv zeta. rewrite plus_IZR, !mult_IZR.
  assert (G : forall p q r s u v, IZR p <= u <= IZR q -> IZR r <= v <= IZR s ->
    (u - v) * (u - v) <= IZR (Z.max (q - r) (s - p)) * IZR (Z.max (q - r) (s - p))).
  { intros p q r s u v P Q. apply square_le. left.
    pose proof (IZR_le _ _ (Z.le_max_l (q - r) (s - p))) as L. pose proof (IZR_le _ _ (Z.le_max_r (q - r) (s - p))) as M.
    rewrite minus_IZR in L, M. lra. }
  pose proof (G _ _ _ _ _ _ Ax Bx). pose proof (G _ _ _ _ _ _ Ay By). unfold dist2. lra.
Qed.

Lemma near2_below S a b x y : in_box S a x -> in_box S b y -> IZR (near2 a b) <= S * S * dist2 x y.
Proof.
  intros [Ax Ay] [Bx By]. unfold near2. cbv zeta. rewrite plus_IZR, !mult_IZR.
  assert (G : forall p q r s u v, IZR p <= u <= IZR q -> IZR r <= v <= IZR s ->
    IZR (off p q r s) * IZR (off p q r s) <= (u - v) * (u - v)).
  { intros p q r s u v P Q. unfold off.
    destruct (Z.max_spec 0 (Z.max (r - q) (p - s))) as [[L ->] | [L ->]]; [| rewrite Rmult_0_l; apply Rle_0_sqr].
    destruct (Z.max_spec (r - q) (p - s)) as [[M E] | [M E]]; rewrite E in *; apply IZR_lt in L; rewrite minus_IZR in *;
      apply square_le; [left | right]; lra. }
  pose proof (G _ _ _ _ _ _ Ax Bx). pose proof (G _ _ _ _ _ _ Ay By). unfold dist2. lra.
Qed.

Section Covered.
Variables (N : nat) (B : sites) (S U : R) (place : Z -> nat).
Variable rough_unit : 0 < S.
Variable exact_unit : 0 < U.

(* c is site k. *)
Definition stands (c : far_site) (k : nat) : Prop :=
  (k < N)%nat /\ (forall x, inside x (B k) -> in_box S (rough c) x) /\ (forall x, inside x (B k) -> in_box U (exact c) x) /\
  diameter_le (B k) (IZR (width c) / (U * 2 ^ 64)) /\ k = place (box_name (exact c)).

Lemma far_above b z c k : in_box S b z -> stands c k -> S * S * (dl z (B k) * dl z (B k)) <= IZR (length2 b (rough c)).
Proof.
  intros Z (_ & R & _). unfold dl. rewrite dist_sq. apply length2_above; [exact Z | apply R, farthest_inside].
Qed.

Lemma near_below b z c k : in_box S b z -> stands c k -> IZR (near2 b (rough c)) <= S * S * (ds z (B k) * ds z (B k)).
Proof.
  intros Z (_ & R & _). unfold ds. rewrite dist_sq. apply near2_below; [exact Z | apply R, nearest_inside].
Qed.

Lemma apart_sound a b i k : stands a i -> stands b k -> are_apart (exact a) (exact b) = true -> VoronoiBounds.apart (B i) (B k).
Proof.
  intros (_ & _ & A & _) (_ & _ & C & _) H x X Y. destruct (A x X) as [Ax Ay]. destruct (C x Y) as [Cx Cy].
  unfold are_apart in H. rewrite !orb_true_iff, !Z.ltb_lt in H. destruct H as [[[H | H] | H] | H]; apply IZR_lt in H; lra.
Qed.

Lemma outermost_in l c : In c (all_outermost l) -> In c l.
Proof.
  destruct l as [| a l]; [easy |]. unfold all_outermost, outermost. intros H. apply in_map_iff in H.
  destruct H as [f [<- _]]. assert (G : forall m best, In (fold_left (better f) m best) (best :: m)).
  { induction m as [| i m IH]; intros best; [now left |]. simpl. destruct (IH (better f best i)) as [E | I]; [| right; now right].
    rewrite <- E. unfold better. destruct (f _ _); [right; now left | now left]. }
  apply G.
Qed.

Lemma seen_in q l c n f : In (c, (n, f)) (seen q l) <-> In c l /\ n = near2 q (rough c) /\ f = length2 q (rough c).
Proof.
  unfold seen. assert (G : forall found, In (c, (n, f)) (fold_left (fun found c => (c, (near2 q (rough c), length2 q (rough c))) :: found) l found)
    <-> (In c l /\ n = near2 q (rough c) /\ f = length2 q (rough c)) \/ In (c, (n, f)) found).
  { induction l as [| a l IH]; intros found; simpl; [tauto |]. rewrite IH. simpl. split.
    - intros [H | [H | H]]; [tauto | injection H as <- <- <-; tauto | tauto].
    - intros [[[<- | H] [-> ->]] | H]; [right; now left | tauto | tauto]. }
  rewrite G. simpl. tauto.
Qed.

Lemma least_of_in l first : least_of l first = first \/ exists c, In c l /\ snd (snd c) = least_of l first.
Proof.
  unfold least_of. revert first. induction l as [| a l IH]; intros first; [now left |]. simpl.
  destruct (IH (Z.min first (snd (snd a)))) as [E | [c [I E]]]; [| right; exists c; tauto].
  rewrite E. destruct (Z.min_spec first (snd (snd a))) as [[_ ->] | [_ ->]]; [now left |]. right. exists a. tauto.
Qed.

Variable root : Z -> Z.
Variables (p q most2 : Z) (h : R).
Variable fraction : h * S * IZR q = IZR p.
Variable positive : (0 < q)%Z.
Variable bound : 0 <= h.
Variable rounded : (most2 * (q * q) <= p * p)%Z.

Lemma within_bound b z c k : in_box S b z -> stands c k -> (length2 b (rough c) <= most2)%Z -> dl z (B k) <= h.
Proof.
  intros I C H. pose proof (far_above b z c k I C) as F. apply IZR_le in H. apply IZR_le in rounded. rewrite !mult_IZR in rounded.
  apply IZR_lt in positive. apply le_of_squares; [exact bound |]. rewrite <- fraction in rounded.
  assert (Q : 0 < (S * S) * (IZR q * IZR q)) by (apply Rmult_lt_0_compat; nra).
  apply (Rmult_le_reg_l _ _ _ Q). assert (IZR q * IZR q * IZR most2 <= h * S * IZR q * (h * S * IZR q)) by lra.
  assert (IZR q * IZR q * (S * S * (dl z (B k) * dl z (B k))) <= IZR q * IZR q * IZR most2) by (apply Rmult_le_compat_l; nra). lra.
Qed.

(* The facts known of a possible site of a box. *)
Definition known (z : point) (a : possible_site) : Prop := forall k, stands (it a) k ->
  S * dl z (B k) <= IZR (reach_of a) /\
  (by_other a = true -> exists j, (j < N)%nat /\ VoronoiBounds.apart (B k) (B j) /\ dl z (B j) <= h).

(* The site of j, or the bisector, is near. *)
Definition near_pair (z : point) (i j : nat) : Prop :=
  (exists k, (k < N)%nat /\ VoronoiBounds.apart (B i) (B k) /\ dl z (B k) <= h) \/
  (exists s di dj, 0 < s /\ (forall x y, inside x (B i) -> inside y (B j) -> s <= dist x y) /\
    diameter_le (B i) di /\ diameter_le (B j) dj /\ (di + dj) * (dl z (B i) + dl z (B j)) <= 2 * h * s).

Lemma pair_sound z a b i j : known z a -> known z b -> stands (it a) i -> stands (it b) j ->
  pair_is_near p q a b = true -> near_pair z i j.
Proof.
  intros Ka Kb A C H. unfold pair_is_near in H. cbv zeta in H. apply orb_true_iff in H. destruct H as [H | H].
  - apply andb_true_iff in H. destruct (Ka i A) as [_ G]. left. now apply G.
  - apply andb_true_iff in H. destruct H as [G H]. apply Z.ltb_lt in G. apply Z.leb_le in H.
    destruct (Ka i A) as [Ra _]. destruct (Kb j C) as [Rb _]. destruct A as (_ & _ & Ea & Da & _). destruct C as (_ & _ & Eb & Db & _).
    set (g := near2 (exact (it a)) (exact (it b))) in *. apply IZR_lt in G. apply IZR_le in H.
    rewrite Z.shiftl_mul_pow2 in H by lia. rewrite !mult_IZR, !plus_IZR in H. right.
    exists (sqrt (IZR g) / U), (IZR (width (it a)) / (U * 2 ^ 64)), (IZR (width (it b)) / (U * 2 ^ 64)).
    pose proof (sqrt_lt_R0 _ G) as G0. pose proof (sqrt_sqrt (IZR g) (Rlt_le _ _ G)) as G2. set (r := sqrt (IZR g)) in *.
    split; [now apply Rdiv_lt_0_compat |]. split; [| split; [exact Da | split; [exact Db |]]].
    + intros x y X Y. pose proof (near2_below U _ _ x y (Ea x X) (Eb y Y)) as L. fold g in L. rewrite <- G2 in L.
      apply (Rmult_le_reg_r U); [exact exact_unit |]. replace (r / U * U) with r by (field; lra).
      rewrite <- dist_sq in L. pose proof (dist_nonneg x y). apply le_of_squares; nra.
    + apply IZR_lt in positive. set (u := IZR (width (it a)) + IZR (width (it b))) in *.
      set (f := IZR (reach_of a) + IZR (reach_of b)) in *.
      assert (T : IZR (2 ^ 128) = 2 ^ 64 * 2 ^ 64) by (rewrite <- pow_add; apply eq_sym, (pow_IZR 2 128)).
      rewrite T, <- fraction, <- G2 in H.
      assert (V : 0 < 2 ^ 64) by (apply pow_lt; lra). set (v := 2 ^ 64) in *.
      assert (Q0 : 0 <= h * S) by nra.
      assert (M : IZR q * (u * f) <= 2 * (h * S * IZR q) * r * v).
      { apply le_of_squares; [repeat apply Rmult_le_pos; lra |]. lra. }
      assert (M2 : u * f <= 2 * (h * S) * r * v) by (apply (Rmult_le_reg_l (IZR q)); [exact positive | lra]).
      assert (U0 : 0 <= u).
      { assert (X : forall c k, diameter_le (B k) (IZR (width c) / (U * v)) -> 0 <= IZR (width c)).
        { intros c k D. pose proof (D _ _ (nearest_inside z (B k)) (nearest_inside z (B k))) as L. rewrite dist_self in L.
          assert (0 < U * v) by nra. apply (Rmult_le_compat_r (U * v)) in L; [| lra].
          replace (IZR (width c) / (U * v) * (U * v)) with (IZR (width c)) in L by (field; lra). lra. }
        pose proof (X _ _ Da). pose proof (X _ _ Db). unfold u. lra. }
      assert (F : u * (S * (dl z (B i) + dl z (B j))) <= u * f) by (apply Rmult_le_compat_l; unfold f; lra).
      assert (W : u * (dl z (B i) + dl z (B j)) <= 2 * h * r * v) by (apply (Rmult_le_reg_l S); [exact rough_unit | lra]).
      replace (IZR (width (it a)) / (U * v) + IZR (width (it b)) / (U * v)) with (u / (U * v)) by (unfold u; field; lra).
      apply (Rmult_le_reg_r (U * v)); [nra |].
      replace (u / (U * v) * (dl z (B i) + dl z (B j)) * (U * v)) with (u * (dl z (B i) + dl z (B j))) by (field; lra).
      replace (2 * h * (r / U) * (U * v)) with (2 * h * r * v) by (field; lra). exact W.
Qed.

Lemma off_sym a b c d : off a b c d = off c d a b.
Proof. unfold off. lia. Qed.

Lemma pair_sym a b : pair_is_near p q a b = pair_is_near p q b a.
Proof.
  unfold pair_is_near. cbv zeta. rewrite (andb_comm (by_other a)).
  replace (near2 (exact (it b)) (exact (it a))) with (near2 (exact (it a)) (exact (it b)))
    by (unfold near2; cbv zeta; now rewrite !(off_sym _ _ (_ (exact (it b))))).
  now rewrite (Z.add_comm (width (it b))), (Z.add_comm (reach_of b)).
Qed.

Lemma pairs_sound z l a b i j : pairs_are_near p q l = true -> (forall c, In c l -> known z c) -> In a l -> In b l ->
  stands (it a) i -> stands (it b) j -> i <> j -> near_pair z i j.
Proof.
  induction l as [| c l IH]; [intros _ _ [] |]. simpl. rewrite andb_true_iff, forallb_forall. intros [F G] K I J A C M.
  destruct I as [-> | I], J as [-> | J].
  - destruct A as (_ & _ & _ & _ & ->), C as (_ & _ & _ & _ & ->). congruence.
  - apply (pair_sound z a b); try assumption; [apply K; tauto | apply K; tauto | now apply F].
  - apply (pair_sound z a b); try assumption; [apply K; tauto | apply K; tauto |]. rewrite pair_sym. now apply F.
  - apply IH; try assumption. intros c0 I0. apply K. tauto.
Qed.

Lemma possible_onto_sound z edge : (forall c, In c edge -> exists k, stands c k /\ dl z (B k) <= h) ->
  forall l before s, possible_onto root edge l before = Some s ->
  (forall c k, In c l -> stands (fst c) k -> S * S * (dl z (B k) * dl z (B k)) <= IZR (snd (snd c))) ->
  (forall a, In a before -> known z a) ->
  (forall a, In a s -> known z a) /\
  (forall c, In c l -> exists a, In a s /\ it a = fst c) /\ (forall a, In a before -> In a s).
Proof.
  intros Hedge. induction l as [| c l IH]; intros before s H F K; simpl in H.
  - injection H as <-. split; [exact K |]. split; [easy | tauto].
  - unfold root_above in H. set (r := root (snd (snd c))) in *.
    destruct ((0 <=? r)%Z && (snd (snd c) <=? r * r)%Z) eqn:G; [| discriminate].
    apply andb_true_iff in G. destruct G as [G0 G]. apply Z.leb_le in G0, G. apply IZR_le in G0, G. rewrite mult_IZR in G.
    destruct (IH _ _ H) as (A & C & L).
    + intros d k I. apply F. now right.
    + intros a [<- | I]; [| now apply K]. intros k T. cbn [it reach_of by_other] in *. split.
      * apply le_of_squares; [exact G0 |]. pose proof (F c k (or_introl eq_refl) T). lra.
      * intros E. apply existsb_exists in E. destruct E as [d [I E]]. destruct (Hedge d I) as [j [J D]].
        exists j. split; [apply J |]. split; [now apply (apart_sound (fst c) d) | exact D].
    + split; [exact A |]. split; [| intros a I; apply L; now right].
      intros d [<- | I]; [| now apply C]. eexists. split; [apply L; now left | reflexivity].
Qed.

Lemma quarters_in_box b z : in_box S b z -> exists part, In part (quarters b) /\ in_box S part z.
Proof.
  intros [X Y]. unfold quarters. cbv zeta. set (x := ((x0 b + x1 b) / 2)%Z). set (y := ((y0 b + y1 b) / 2)%Z).
  destruct (Rle_dec (S * fst z) (IZR x)) as [P | P], (Rle_dec (S * snd z) (IZR y)) as [Q | Q];
    [exists (Box 0 (x0 b) x (y0 b) y) | exists (Box 0 (x0 b) x y (y1 b)) | exists (Box 0 x (x1 b) (y0 b) y) |
     exists (Box 0 x (x1 b) y (y1 b))]; (split; [simpl; tauto | unfold in_box; cbn [x0 x1 y0 y1]; lra]).
Qed.

Lemma fold_none {A : Type} (f : option A -> box -> option A) l : (forall b, f None b = None) -> fold_left f l None = None.
Proof. intros H. induction l as [| b l IH]; [reflexivity |]. simpl. now rewrite H. Qed.

Lemma fold_each (f : Z -> box -> option Z) l : forall e left,
  fold_left (fun left part => match left with Some e => f e part | None => None end) l (Some e) = Some left ->
  forall part, In part l -> exists e' left', f e' part = Some left'.
Proof.
  induction l as [| b l IH]; intros e left H part I; [destruct I |]. simpl in H. destruct (f e b) as [e1 |] eqn:F.
  - destruct I as [<- | I]; [now exists e, e1 | exact (IH e1 left H part I)].
  - rewrite fold_none in H by reflexivity. discriminate.
Qed.

Variable choices : nat -> point.
Variable chosen : choice N B choices.
Variable some_site : (1 <= N)%nat.

Theorem box_sound z depth : undetermined N B z -> forall effort before b l left,
  box_holds root p q most2 depth effort before b l = Some left -> in_box S b z ->
  (forall c, In c l -> exists k, stands c k) -> (forall k, (k < N)%nat -> pos N B k z -> exists c, In c l /\ stands c k) ->
  exists w, diagram N choices w /\ dist z w <= h.
Proof.
  intros Un. induction depth as [| depth IH]; intros effort before b l left H Z0 Here All; cbn [box_holds] in H; cbv zeta in H;
    remember (seen b l) as here eqn:Q; (destruct here as [| first' more]; [discriminate |]);
    rewrite Q in H; set (least := least_of (seen b l) (snd (snd first'))) in *;
    set (some := kept (fun c => (fst (snd c) <=? least)%Z) (seen b l)) in *;
    set (edge := all_outermost (map fst (kept (fun c => (snd (snd c) <=? most2)%Z) (seen b l)))) in *;
    (assert (Edge : forall c, In c edge -> exists k, stands c k /\ dl z (B k) <= h);
     [intros c I; apply outermost_in, in_map_iff in I; destruct I as [[c' [n f]] [E I]]; simpl in E; subst c'; apply kept_in in I;
      destruct I as [I F]; simpl in F; apply Z.leb_le in F; apply seen_in in I; destruct I as (I & _ & ->);
      destruct (Here c I) as [k K]; exists k; split; [exact K | now apply (within_bound b z c k)] |]);
    (assert (Least : exists c k, In c l /\ stands c k /\ S * S * (dl z (B k) * dl z (B k)) <= IZR least);
     [assert (X : exists c, In c (seen b l) /\ snd (snd c) = least);
      [destruct (least_of_in (seen b l) (snd (snd first'))) as [E | E]; [exists first'; split; [rewrite <- Q; apply in_eq | symmetry; exact E] | exact E] |];
      destruct X as [[c [n f]] [I E]]; simpl in E; apply seen_in in I; destruct I as (I & _ & E'); destruct (Here c I) as [k K];
      exists c, k; split; [exact I | split; [exact K |]]; rewrite <- E, E'; now apply (far_above b z c k) |]);
    (assert (Some_in : forall k, (k < N)%nat -> pos N B k z -> exists c, In c l /\ stands c k /\ (near2 b (rough c) <= least)%Z);
     [intros k K P; destruct (All k K P) as [c [I C]]; exists c; split; [exact I | split; [exact C |]];
      apply le_IZR; destruct Least as (d & m & _ & M & L); pose proof (near_below b z c k Z0 C) as X;
      pose proof (P m (proj1 M)) as Y; pose proof (ds_nonneg z (B k)); 
      assert (ds z (B k) * ds z (B k) <= dl z (B m) * dl z (B m)) by (apply Rmult_le_compat; lra);
      assert (S * S * (ds z (B k) * ds z (B k)) <= S * S * (dl z (B m) * dl z (B m))) by (apply Rmult_le_compat_l; nra); lra |]);
    (destruct (existsb (is_apart_from_some edge) edge) eqn:Two;
     [apply existsb_exists in Two; destruct Two as [c [I Two]]; apply existsb_exists in Two; destruct Two as [d [J Two]];
      destruct (Edge c I) as [k [K Dk]]; destruct (Edge d J) as [m [M Dm]];
      apply (voronoi_second N B choices z h some_site chosen); intros i Ii Pi; right; exists k, m;
      repeat split; try assumption; [apply K | apply M | now apply (apart_sound c d)] |]);
    match type of H with (if ?x && ?y then _ else _) = _ => destruct x eqn:Lk; destruct y eqn:Pr; cbn [andb] in H end;
    try (destruct (possible_onto root edge some []) as [s |] eqn:So; [| discriminate Pr];
      apply (undetermined_near N B choices z h some_site bound chosen Un); intros i j I J M Pi Pj;
      destruct (possible_onto_sound z edge Edge some [] s So) as (K & C & _);
      [intros [c [n f]] k Ic Ck; apply kept_in in Ic; destruct Ic as [Ic _]; apply seen_in in Ic; destruct Ic as (_ & _ & ->);
       now apply (far_above b z c k) | easy |];
      destruct (Some_in i I Pi) as (ci & Li & Si & Ni); destruct (Some_in j J Pj) as (cj & Lj & Sj & Nj);
      destruct (C (ci, (near2 b (rough ci), length2 b (rough ci)))) as [a [Ia Ea]];
      [apply in_kept; [now apply seen_in | now apply Z.leb_le] |];
      destruct (C (cj, (near2 b (rough cj), length2 b (rough cj)))) as [d [Id Ed]];
      [apply in_kept; [now apply seen_in | now apply Z.leb_le] |];
      simpl in Ea, Ed; apply (pairs_sound z s a d); try assumption; congruence);
    try discriminate.
  all: match type of H with (if ?x then _ else _) = _ => destruct x; [| discriminate] end;
    destruct (quarters_in_box b z Z0) as [part [Ip Zp]];
    destruct (fold_each _ _ _ _ H part Ip) as (e' & left' & H'); apply (IH _ _ _ _ _ H' Zp);
    [intros c I; apply in_map_iff in I; destruct I as [[c' [n f]] [E I]]; simpl in E; subst c'; apply kept_in in I;
     destruct I as [I _]; apply seen_in in I; now apply Here |];
    intros k K P; destruct (Some_in k K P) as (c & Ic & C & L); exists c; (split; [| exact C]);
    apply in_map_iff; exists (c, (near2 b (rough c), length2 b (rough c))); (split; [reflexivity |]);
    (apply in_kept; [now apply seen_in |]); simpl; apply orb_true_iff; left; now apply Z.leb_le.
Qed.
End Covered.

(* ---- the certificate ---- *)

Lemma far_sites_in root k l : forall before s, far_sites root k l before = Some s ->
  (forall c, In c s -> In c before \/ exists b r, In b l /\ c = FarSite (coarse k b) b r /\ (0 <= r)%Z /\
    (Z.shiftl (diameter2 b) 128 <= r * r)%Z) /\
  (forall c, In c before -> In c s) /\ (forall b, In b l -> exists r, In (FarSite (coarse k b) b r) s).
Proof.
  induction l as [| b l IH]; intros before s H; cbn [far_sites] in H.
  - injection H as <-. split; [tauto |]. split; [easy |]. now intros b [].
  - unfold root_above in H. cbv zeta in H. set (r := root (Z.shiftl (diameter2 b) 128)) in *.
    destruct ((0 <=? r)%Z && (Z.shiftl (diameter2 b) 128 <=? r * r)%Z) eqn:G; [| discriminate].
    apply andb_true_iff in G. rewrite !Z.leb_le in G. destruct G as [G0 G].
    destruct (IH _ _ H) as (A & C & F). split; [| split].
    + intros c I. destruct (A c I) as [[<- | I'] | (b' & r' & I' & Q)].
      * right. exists b, r. repeat split; try assumption. now left.
      * now left.
      * right. exists b', r'. split; [now right | exact Q].
    + intros c I. apply C. now right.
    + intros b' [<- | I]; [exists r; apply C; now left | now apply F].
Qed.

Lemma width_diameter U b A r : 0 < U -> is_box U b A -> (0 <= r)%Z -> (Z.shiftl (diameter2 b) 128 <= r * r)%Z ->
  diameter_le A (IZR r / (U * 2 ^ 64)).
Proof.
  intros P I R0 H. apply IZR_le in R0, H. rewrite Z.shiftl_mul_pow2, !mult_IZR in H by lia.
  assert (T : IZR (2 ^ 128) = 2 ^ 64 * 2 ^ 64) by (rewrite <- pow_add; apply eq_sym, (pow_IZR 2 128)).
  rewrite T in H. assert (V : 0 < 2 ^ 64) by (apply pow_lt; lra). set (v := 2 ^ 64) in *.
  assert (UV : 0 < U * v) by now apply Rmult_lt_0_compat.
  apply (diameter_value U b A _ P I); [now apply Rle_mult_inv_pos |].
  assert (V2 : 0 < v * v) by now apply Rmult_lt_0_compat.
  apply (Rmult_le_reg_r (v * v)); [exact V2 |].
  replace (U * U * (IZR r / (U * v) * (IZR r / (U * v))) * (v * v)) with (IZR r * IZR r) by (field; lra). exact H.
Qed.

(* The bound in units of 2^k / unit. *)
Lemma bound_fraction D E k n : (0 <= k)%Z -> (0 < den n)%Z ->
  let j := (expo n + E - k)%Z in
  value n * (unit D E / IZR (2 ^ k)) * IZR (Z.shiftl (den n) (Z.max 0 (- j))) = IZR (Z.shiftl (man n * D) (Z.max 0 j)).
Proof.
  intros K Q j. rewrite !shift_value by lia. rewrite mult_IZR. unfold value, unit. apply IZR_lt in Q.
  assert (T : IZR (2 ^ k) = powerRZ 2 k).
  { pose proof (shift_value 1 k K) as T. rewrite Z.shiftl_mul_pow2, Z.mul_1_l, Rmult_1_l in T by exact K. exact T. }
  rewrite T. assert (N : 2 <> 0) by lra. pose proof (powerRZ_lt 2 k ltac:(lra)) as Pk.
  assert (X : powerRZ 2 (expo n) * powerRZ 2 E * powerRZ 2 (Z.max 0 (- j)) = powerRZ 2 (Z.max 0 j) * powerRZ 2 k).
  { rewrite <- !powerRZ_add by exact N. f_equal. unfold j. lia. }
  apply (Rmult_eq_reg_r (powerRZ 2 k)); [| lra].
  replace (IZR (man n) * powerRZ 2 (expo n) / IZR (den n) * (IZR D * powerRZ 2 E / powerRZ 2 k) *
      (IZR (den n) * powerRZ 2 (Z.max 0 (- j))) * powerRZ 2 k)
    with (IZR (man n) * IZR D * (powerRZ 2 (expo n) * powerRZ 2 E * powerRZ 2 (Z.max 0 (- j)))) by (field; lra).
  rewrite X. ring.
Qed.

Lemma box_holds_some root p q most2 depth effort before b l left :
  box_holds root p q most2 depth effort before b l = Some left -> exists c, In c l.
Proof.
  intros H. destruct l as [| c l]; [| exists c; apply in_eq]. destruct depth; discriminate H.
Qed.

(* Every point of the window that is nearest to no site for every choice is within the bound of the diagram of each. *)
Theorem accepted_distance D E l (w : site) B W root k effort bound p z : describes l B -> describes [w] (fun _ => W) ->
  distance_holds root k effort D E l w bound = true -> choice (length l) B p -> inside z W ->
  undetermined (length l) B z -> exists x, diagram (length l) p x /\ dist z x <= value bound.
Proof.
  intros F Fw H P Z0 Un. unfold distance_holds in H. destruct (scaled_sites D E l) as [bs |] eqn:Sc; [| discriminate].
  destruct (scaled_site D E w) as [b |] eqn:Sw; [| discriminate]. cbv zeta in H.
  set (j := (expo bound + E - k)%Z) in *. set (u := Z.shiftl (man bound * D) (Z.max 0 j)) in *.
  set (v := Z.shiftl (den bound) (Z.max 0 (- j))) in *.
  destruct (check D E l []) eqn:C; [| discriminate]. cbn [andb] in H. rewrite !andb_true_iff, !Z.leb_le, Z.ltb_lt in H.
  destruct H as [[[M Q] K] H]. destruct (far_sites root k bs []) as [far |] eqn:Fs; [| discriminate].
  destruct (box_holds _ _ _ _ _ _ _ _ _) as [left |] eqn:X; [| discriminate].
  destruct (accepted_parts D E l [] C) as (bs' & Sc' & P0 & R0 & _). assert (bs' = bs) by congruence. subst bs'. clear Sc'.
  pose proof (unit_pos D E P0) as U. assert (K0 : 0 < IZR (2 ^ k)) by (apply IZR_lt, Z.pow_pos_nonneg; lia).
  set (S := unit D E / IZR (2 ^ k)). assert (S0 : 0 < S) by now apply Rdiv_lt_0_compat.
  destruct (Fw 0%nat w eq_refl) as (X0 & X1 & Y0 & Y1). destruct (scaled_site_box D E w b W P0 Sw X0 X1 Y0 Y1) as [Ib _].
  destruct (far_sites_in root k bs [] far Fs) as (A & _ & G).
  assert (St : forall c r, In c bs -> (0 <= r)%Z -> (Z.shiftl (diameter2 c) 128 <= r * r)%Z ->
    stands (length l) B S (unit D E) (position bs) (FarSite (coarse k c) c r) (position bs (box_name c))).
  { intros c r I R1 R2. apply In_nth_error in I. destruct I as [n I].
    pose proof (find_box_nth (-1) bs n _ c R0 I eq_refl) as Fc. destruct (found_named D E l [] B C F bs Sc _ _ Fc) as [_ Kc].
    destruct (found_box D E l [] B C F bs Sc _ _ Fc) as [Bc _]. unfold stands. cbn [rough exact width].
    split; [exact Kc |]. split; [| split; [| split; [| reflexivity]]].
    - exact (coarse_bounds (unit D E) k c _ K U Bc).
    - destruct Bc as (V0 & V1 & V2 & V3). intros x [Ix Iy]. unfold in_box. rewrite V0, V1, V2, V3. split; split; nra.
    - now apply width_diameter with (b := c). }
  assert (Here : forall c, In c far -> exists n, stands (length l) B S (unit D E) (position bs) c n).
  { intros c I. destruct (A c I) as [[] | (c' & r & I' & -> & R1 & R2)]. eexists. now apply St. }
  destruct (box_holds_some _ _ _ _ _ _ _ _ _ _ X) as [c0 I0]. destruct (Here c0 I0) as [n0 [N0 _]].
  assert (V : (0 < v)%Z) by (unfold v; rewrite Z.shiftl_mul_pow2 by lia; apply Z.mul_pos_pos; [exact Q | apply Z.pow_pos_nonneg; lia]).
  refine (box_sound (length l) B S (unit D E) (position bs) S0 U root u v (u * u / (v * v)) (value bound) _ V _ _ p P _ z
    deepest Un effort _ _ far left X _ Here _).
  - apply bound_fraction; assumption.
  - unfold value. apply IZR_le in M. apply IZR_lt in Q. apply Rle_mult_inv_pos; [| exact Q].
    apply Rmult_le_pos; [exact M | left; apply powerRZ_lt; lra].
  - rewrite Z.mul_comm. apply Z.mul_div_le. now apply Z.mul_pos_pos.
  - lia.
  - exact (coarse_bounds (unit D E) k b W K U Ib z Z0).
  - intros n L _. destruct (box_of D E l B F n L bs Sc P0) as (s & c & _ & T & _ & _).
    destruct (G c (nth_error_In _ _ T)) as [r I]. exists (FarSite (coarse k c) c r). split; [exact I |].
    destruct (A _ I) as [[] | (c' & r' & I' & Q' & R1 & R2)]. pose proof (f_equal exact Q') as Qc. pose proof (f_equal width Q') as Qr.
    cbn [exact width] in Qc, Qr. subst c' r'.
    rewrite <- (position_named D E l [] C bs Sc n c T). now apply St.
Qed.
